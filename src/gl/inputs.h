// SPDX-License-Identifier: MIT
// What a pass hands to its program: resources, by the names that GLSL gives them. Names of blocks for buffers
// (`FrameBlock`), of uniforms for textures and images (`voxelFaces`).
//
// A program is given all it reads, each time it runs (Program::dispatch, Program::use): nothing is read from
// a slot that somebody else has filled. What a program reads and the list lacks is an error that names it;
// what the list has and the program does not read is passed over, so that a value may list all it has.
// Which slot a name gets is the program's own affair (Program::slots).
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include "gl/buffer.h"
#include "gl/texture.h"

namespace conelight::gl {

// A name and its hash (FNV-1a), made from a literal while compiling.
class ResourceName {
  public:
    consteval ResourceName(const char* text)
        : text_(text), hash_(hashOf(text)) {}  // NOLINT: a literal is one
    std::string_view text() const { return text_; }
    std::uint64_t hash() const { return hash_; }

    // Of a text that goes on: `hash` is that of what came before.
    static constexpr std::uint64_t hashOf(std::string_view text, std::uint64_t hash = 14695981039346656037u) {
        for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211u;
        return hash;
    }

  private:
    std::string_view text_;
    std::uint64_t hash_;
};

enum class ResourceKind : std::uint8_t { Uniform, Storage, Texture, Image };

// What shaders do with an image.
enum class ImageUse : std::uint8_t { Read, Write, ReadWrite };

class Inputs {
  public:
    // Buffers and textures are referred to until the program has run; neither may be empty.
    Inputs& uniform(ResourceName block, const Buffer& buffer);
    Inputs& storage(ResourceName block, const Buffer& buffer);
    // Without a sampler the texture's own parameters count.
    Inputs& texture(ResourceName name, const Texture& texture, const Sampler* sampler = nullptr);
    // A texture of the host's, by its GL name, with a sampler of ours.
    Inputs& foreignTexture(ResourceName name, Name texture, const Sampler& sampler);
    // A buffer of the host's, by its GL name.
    Inputs& foreignStorage(ResourceName block, Name buffer);
    Inputs& image(ResourceName name, const Texture& texture, ImageUse use, int level = 0);
    // A texture that the draw calls of the pass bind themselves, one after the other (Program::unitOf).
    Inputs& perDraw(ResourceName name);
    // All that a value has for shaders: V has `void declare(gl::Inputs&) const`.
    template <class V>
    Inputs& add(const V& value) {
        value.declare(*this);
        return *this;
    }

    struct Item {
        ResourceName name;
        ResourceKind kind;
        Name object = 0;   // 0: per draw
        Name sampler = 0;  // 0: none
        std::uint32_t format = 0;
        int level = 0;
        ImageUse use = ImageUse::Read;
    };
    const std::vector<Item>& items() const { return items_; }

  private:
    std::vector<Item> items_;
};

}  // namespace conelight::gl
