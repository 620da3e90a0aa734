// SPDX-License-Identifier: MIT
// Textures of immutable storage, views of buffers as textures, samplers.
// Creation throws Error(Runtime): a size beyond the driver's limits, no memory, an unknown format.
// clear(), copyFrom() and read() see and follow what shaders wrote before; uploads do only after
// barrier(Access::Update). Transfers set the alignment of rows and rely on GL's defaults for the rest of the
// pixel store state, which HostStateGuard provides.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <string>

#include "gl/buffer.h"
#include "gl/object.h"

namespace conelight::gl {

struct TextureDesc {
    std::uint32_t target;  // GL_TEXTURE_2D, _2D_ARRAY, _3D, _CUBE_MAP, _CUBE_MAP_ARRAY, _BUFFER
    std::uint32_t format;  // sized internal format
    int width = 1;
    int height = 1;
    int depth = 1;   // layers for arrays (6 per cube); 1 for a single cube
    int levels = 1;  // 0: the full chain
    // Shaders read and write single texels and know the size from elsewhere: the storage may be larger, so that its edges
    // are no powers of two (but for height and depth from 32). llvmpipe builds kernels once more for those
    // (gl/sampler_slots.h).
    bool uneven = false;
};

class Texture : public Object<ObjectType::Texture> {
  public:
    Texture() = default;
    Texture(const TextureDesc& desc, const std::string& label);
    // A GL_TEXTURE_BUFFER that reads `buffer` (not owned) as texels of `format`. For textureSize() of GLSL it may have
    // more texels, of any value, than the buffer.
    Texture(const Buffer& buffer, std::uint32_t format, const std::string& label);

    const TextureDesc& desc() const { return desc_; }
    int width(int level = 0) const;
    int height(int level = 0) const;
    int depth(int level = 0) const;  // slices or layers; 6 for a cube

    // One level, all layers, from host memory; type and layout as in glTextureSubImage. Rows are tight.
    void upload(int level, std::uint32_t layout, std::uint32_t type, const void* data);
    void uploadLayer(int level, int layer, std::uint32_t layout, std::uint32_t type, const void* data);
    void generateMipmaps();
    void clear(int level, std::uint32_t layout, std::uint32_t type, const void* texel);  // null: zero
    // A box of one level to zero.
    void clearRegion(int level, const glm::ivec3& offset, const glm::ivec3& size, std::uint32_t layout,
                     std::uint32_t type);
    void copyFrom(const Texture& source);  // level 0, of a texture of the same size and format
    // The first so many layers, all levels, of an array of the same edges and format.
    void copyLayers(const Texture& source, int layers);
    // One level of a layer of an array from that level of a GL_TEXTURE_2D of the same edges, whose texels have as many bytes.
    void copyLayer(int level, int layer, const Texture& source);
    void read(int level, std::uint32_t layout, std::uint32_t type, void* data, std::size_t bytes) const;
    // A box of level 0.
    void readRegion(const glm::ivec3& offset, const glm::ivec3& size, std::uint32_t layout,
                    std::uint32_t type, void* data, std::size_t bytes) const;

    void parameter(std::uint32_t name, int value);
    void bind(unsigned unit) const;  // texture unit, for draw calls that bind textures themselves

    // Bytes of the storage of `desc`, all levels.
    static std::size_t storageBytes(const TextureDesc& desc);

  private:
    TextureDesc desc_{};
};

struct SamplerDesc {
    std::uint32_t minFilter;  // GL_LINEAR_MIPMAP_LINEAR ...
    std::uint32_t magFilter;
    std::uint32_t wrap;         // all axes
    std::uint32_t wrapV = 0;    // 0: as wrap
    bool depthCompare = false;  // GL_LEQUAL comparison
    float maxAnisotropy = 1.0f;
};

class Sampler : public Object<ObjectType::Sampler> {
  public:
    Sampler() = default;
    Sampler(const SamplerDesc& desc, const std::string& label);
    void bind(unsigned unit) const;
};

// Forgets the sampler object of a unit: the texture's own parameters count again.
void unbindSampler(unsigned unit);

// A texture of the host's, by its GL name. Without texels (width 0) where the name is of no GL_TEXTURE_2D.
struct TextureShape {
    int width = 0, height = 0;  // of the base level
    bool floats = false;        // or normalized numbers
    bool mipmapped = false;     // has all levels below the base level
};
TextureShape shapeOfForeign(Name texture);
void bindForeignTexture(unsigned unit, Name texture);

// Makes room for `bytes` in `buffer` and in `texels`, which reads it. What was there may be lost. A quarter is
// left in reserve where a list grows, none where there was no list.
void reserveTexels(Buffer& buffer, Texture& texels, std::uint32_t format, std::size_t bytes,
                   const std::string& label);

}  // namespace conelight::gl
