// SPDX-License-Identifier: MIT
// Scene to bytes and back: one list of fields per struct (`visit`), walked by a writer and by a reader, so
// that the two cannot disagree. Every length is checked against what is left before memory is taken.
#include "io/scene_stream.h"

#include <cstring>
#include <type_traits>

#include "conelight/error.h"
#include "conelight/scene_fields.h"

namespace conelight::io {

namespace {

class StreamWriter {
  public:
    template <typename T>
    void plain(const T& value) {
        static_assert(std::is_trivially_copyable_v<T>);
        append(&value, sizeof value);
    }
    template <typename T>
    void array(const std::vector<T>& values) {
        static_assert(std::is_trivially_copyable_v<T>);
        plain(std::uint64_t(values.size()));
        append(values.data(), values.size() * sizeof(T));
    }
    void text(const std::string& value) {
        plain(std::uint64_t(value.size()));
        append(value.data(), value.size());
    }
    template <typename T>
    void optional(const std::optional<T>& value) {
        plain(value.has_value());
        if (value) plain(*value);
    }
    template <typename T>
    std::size_t count(const std::vector<T>& values) {
        plain(std::uint64_t(values.size()));
        return values.size();
    }
    Bytes bytes;

  private:
    void append(const void* data, std::size_t size) {
        if (size == 0) return;
        const auto* from = static_cast<const std::uint8_t*>(data);
        bytes.insert(bytes.end(), from, from + size);
    }
};

class StreamReader {
  public:
    explicit StreamReader(std::span<const std::uint8_t> bytes) : left_(bytes) {}
    template <typename T>
    void plain(T& value) {
        take(&value, sizeof value);
    }
    template <typename T>
    void array(std::vector<T>& values) {
        values.resize(length(sizeof(T)));
        take(values.data(), values.size() * sizeof(T));
    }
    void text(std::string& value) {
        value.resize(length(1));
        take(value.data(), value.size());
    }
    template <typename T>
    void optional(std::optional<T>& value) {
        bool given = false;
        plain(given);
        if (given) plain(value.emplace());
    }
    template <typename T>
    std::size_t count(std::vector<T>& values) {
        values.resize(length(1));  // every element takes at least one byte
        return values.size();
    }
    bool atEnd() const { return left_.empty(); }

  private:
    std::size_t length(std::size_t elementSize) {
        std::uint64_t count = 0;
        plain(count);
        if (count > left_.size() / elementSize) fail();
        return std::size_t(count);
    }
    void take(void* out, std::size_t size) {
        if (size > left_.size()) fail();
        if (size != 0) std::memcpy(out, left_.data(), size);
        left_ = left_.subspan(size);
    }
    [[noreturn]] static void fail() { throw Error(ErrorKind::Runtime, "scene stream: ends early"); }
    std::span<const std::uint8_t> left_;
};

template <typename Stream, typename M>
void visitMesh(Stream& s, M& mesh) {
    s.text(mesh.name);
    s.array(mesh.positions);
    s.array(mesh.normals);
    s.array(mesh.uvs);
    s.array(mesh.tangents);
    s.array(mesh.colors);
    s.array(mesh.indices);
}

template <typename Stream, typename T>
void visitTexture(Stream& s, T& texture) {
    s.text(texture.name);
    s.plain(texture.width);
    s.plain(texture.height);
    s.plain(texture.srgb);
    s.plain(texture.wrapU);
    s.plain(texture.wrapV);
    s.plain(texture.filter);
    s.array(texture.rgba);
}

void visitProfile(StreamWriter& s, const std::shared_ptr<const LightProfile>& profile) {
    s.plain(profile != nullptr);
    if (!profile) return;
    s.text(profile->file);
    s.text(profile->text);
    s.array(profile->factors);
    s.plain(profile->candela);
}
void visitProfile(StreamReader& s, std::shared_ptr<const LightProfile>& profile) {
    bool given = false;
    s.plain(given);
    if (!given) return;
    auto read = std::make_shared<LightProfile>();
    s.text(read->file);
    s.text(read->text);
    s.array(read->factors);
    s.plain(read->candela);
    profile = std::move(read);
}

// Materials, instances, lights, cameras: their fields stand in scene_fields.h.
template <typename Stream, typename T>
void visitAll(Stream& s, T& object) {
    visitFields(
        [&s](const char*, auto& value) {
            using Value = std::remove_cvref_t<decltype(value)>;
            if constexpr (std::is_same_v<Value, std::string>)
                s.text(value);
            else if constexpr (std::is_same_v<Value, std::optional<PhongMaterial>>)
                s.optional(value);
            else if constexpr (std::is_same_v<Value, std::shared_ptr<const LightProfile>>)
                visitProfile(s, value);
            else
                s.plain(value);
        },
        object);
}

void visitPicture(StreamWriter& s, const std::shared_ptr<const EnvironmentImage>& picture) {
    s.plain(picture != nullptr);
    if (!picture) return;
    s.plain(picture->width);
    s.plain(picture->height);
    s.array(picture->radiance);
}
void visitPicture(StreamReader& s, std::shared_ptr<const EnvironmentImage>& picture) {
    bool given = false;
    s.plain(given);
    if (!given) return;
    auto read = std::make_shared<EnvironmentImage>();
    s.plain(read->width);
    s.plain(read->height);
    s.array(read->radiance);
    picture = std::move(read);
}

template <typename Stream, typename S>
void visitScene(Stream& s, S& scene) {
    s.text(scene.name);
    for (std::size_t i = 0, n = s.count(scene.meshes); i < n; ++i) visitMesh(s, scene.meshes[i]);
    for (std::size_t i = 0, n = s.count(scene.materials); i < n; ++i) visitAll(s, scene.materials[i]);
    for (std::size_t i = 0, n = s.count(scene.textures); i < n; ++i) visitTexture(s, scene.textures[i]);
    for (std::size_t i = 0, n = s.count(scene.instances); i < n; ++i) visitAll(s, scene.instances[i]);
    for (std::size_t i = 0, n = s.count(scene.lights); i < n; ++i) visitAll(s, scene.lights[i]);
    for (std::size_t i = 0, n = s.count(scene.cameras); i < n; ++i) visitAll(s, scene.cameras[i]);
    s.plain(scene.sky);
    s.text(scene.environment.file);
    s.plain(scene.environment.rotation);
    s.plain(scene.environment.strength);
    visitPicture(s, scene.environment.image);
    s.text(scene.format);
    for (std::size_t i = 0, n = s.count(scene.settings); i < n; ++i) {
        s.text(scene.settings[i].first);
        s.text(scene.settings[i].second);
    }
    for (std::size_t i = 0, n = s.count(scene.notes); i < n; ++i) s.text(scene.notes[i]);
}

}  // namespace

Bytes bytesFromScene(const Scene& scene) {
    StreamWriter writer;
    visitScene(writer, scene);
    return std::move(writer.bytes);
}

Scene sceneFromBytes(std::span<const std::uint8_t> bytes) {
    StreamReader reader(bytes);
    Scene scene;
    visitScene(reader, scene);
    if (!reader.atEnd()) throw Error(ErrorKind::Runtime, "scene stream: has bytes left over");
    return scene;
}

}  // namespace conelight::io
