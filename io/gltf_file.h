// SPDX-License-Identifier: MIT
// A glTF container: JSON with checked access, buffers, accessors as plain numbers. Knows nothing of scenes.
// Every index, offset, size and number is checked; errors name file and JSON path. Private to this room.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "io/files.h"
#include "io/scene_folder.h"

namespace conelight::io {

// A value inside the JSON with its path, e.g. "nodes[3].translation". Null when absent.
class GltfValue {
  public:
    GltfValue(const std::string& file, const nlohmann::json* value, std::string path)
        : file_(&file), value_(value), path_(std::move(path)) {}

    bool exists() const { return value_ != nullptr; }
    bool isObject() const { return exists() && value_->is_object(); }
    bool isNumber() const { return exists() && value_->is_number(); }
    const std::string& path() const { return path_; }
    const nlohmann::json& json() const { return *value_; }

    GltfValue operator[](const char* key) const;    // absent when not there
    GltfValue operator[](std::size_t index) const;  // absent when not there
    std::size_t size() const;                       // of an array; 0 when absent; fails on other kinds
    GltfValue extension(const char* name) const;    // extensions.NAME

    // Absent values give `otherwise`; values of the wrong kind, not finite or out of range fail.
    float number(float otherwise) const;
    bool boolean(bool otherwise) const;
    std::string text(const std::string& otherwise) const;
    template <int N>
    glm::vec<N, float> vector(const glm::vec<N, float>& otherwise) const {
        if (!exists()) return otherwise;
        glm::vec<N, float> out;
        numbers(&out[0], N);
        return out;
    }
    void numbers(float* out, std::size_t count) const;
    // A whole number in [0, limit); absent gives nothing.
    std::optional<std::size_t> index(std::size_t limit) const;
    std::uint64_t whole(std::uint64_t otherwise) const;

    [[noreturn]] void fail(const std::string& why) const;

  private:
    const std::string* file_;
    const nlohmann::json* value_;
    std::string path_;
};

class GltfFile {
  public:
    // Reads the file and the buffers it names. Throws Error(BadInput), or GltfVersion1 (gltf.h).
    GltfFile(const std::filesystem::path& path, bool allowOutside);
    GltfFile(const GltfFile&) = delete;
    GltfFile& operator=(const GltfFile&) = delete;

    const std::string& name() const { return file_; }
    GltfValue root() const { return {file_, &json_, ""}; }
    GltfValue array(const char* name) const { return root()[name]; }

    // All elements of an accessor as floats, `components` each (normalized integers become [0,1] or [-1,1]).
    // allowFewer: an accessor with fewer components is padded with `padding`.
    std::vector<float> floats(const GltfValue& accessorIndex, std::size_t components, bool allowFewer = false,
                              float padding = 1.0f);
    // All elements of a scalar or 4-vector accessor of whole numbers.
    std::vector<std::uint32_t> wholes(const GltfValue& accessorIndex, std::size_t components);
    std::size_t accessorCount(const GltfValue& accessorIndex) const;

    // What an accessor says of its elements: componentType, components and count of them.
    struct AccessorShape {
        std::size_t index = 0;
        std::uint64_t type = 0;
        std::size_t components = 0;
        std::uint64_t count = 0;
    };
    AccessorShape shapeOf(const GltfValue& accessorIndex) const;
    // From now on the accessor has these elements, packed without gaps, instead of those of its buffer view.
    void giveElements(std::size_t accessor, Bytes elements) {
        givenElements_[accessor] = std::move(elements);
    }

    // Decompressed where it is compressed. Stays valid.
    std::span<const std::uint8_t> bufferView(const GltfValue& viewIndex);
    // Bytes behind a "uri": data URI or a file in the scene's folder. Fails with a line that starts at the value.
    Bytes uriBytes(const GltfValue& uri) const;
    // Of a value of `images`, in a buffer view or behind a uri.
    Bytes imageBytes(const GltfValue& image);

  private:
    struct Layout;
    struct Elements;
    Layout layoutOf(const GltfValue& accessorIndex) const;
    // Where the elements lie, all of them inside their buffer view; nothing for an accessor without one.
    std::optional<Elements> elementsOf(const Layout& layout);
    // Calls put(element, bytes) for each element that a sparse accessor replaces.
    template <typename Put>
    void putSparse(const Layout& layout, const Put& put);
    void readJson(std::string_view text);
    const Bytes& buffer(std::size_t index);
    // The bytes that `value` names by buffer, byteOffset and byteLength.
    std::span<const std::uint8_t> bytesOf(const GltfValue& value);
    template <typename Number>
    std::vector<Number> read(const GltfValue& accessorIndex, std::size_t components, bool allowFewer,
                             Number padding);

    SceneFolder folder_;
    std::string file_;
    nlohmann::json json_;
    std::optional<Bytes> binaryChunk_;
    std::map<std::size_t, Bytes> buffers_;
    std::map<std::size_t, Bytes> unpackedViews_;
    std::map<std::size_t, Bytes> givenElements_;  // by accessor
    std::uint64_t numbersRead_ = 0;
    std::uint64_t unpackedBytes_ = 0;
};

}  // namespace conelight::io
