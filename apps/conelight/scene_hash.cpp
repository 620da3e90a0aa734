// SPDX-License-Identifier: MIT
#include "scene_hash.h"

#include <fmt/core.h>

#include <cstring>
#include <optional>
#include <type_traits>

#include "conelight/scene_fields.h"

namespace conelight::program {
namespace {

template <class T>
void addVector(Hash& hash, const std::vector<T>& values) {
    hash.add(static_cast<std::uint64_t>(values.size()));
    hash.add(values.data(), values.size() * sizeof(T));
}

void addMesh(Hash& hash, const Mesh& mesh) {
    addVector(hash, mesh.positions);
    addVector(hash, mesh.normals);
    addVector(hash, mesh.uvs);
    addVector(hash, mesh.tangents);
    addVector(hash, mesh.colors);
    addVector(hash, mesh.indices);
}

void addTexture(Hash& hash, const Texture& texture) {
    for (const int value :
         {texture.width, texture.height, static_cast<int>(texture.srgb), static_cast<int>(texture.wrapU),
          static_cast<int>(texture.wrapV), static_cast<int>(texture.filter)})
        hash.add(value);
    addVector(hash, texture.rgba);
}

template <class T>
void addFields(Hash& hash, const T& object);

// Names show in no picture.
void addField(Hash&, const std::string&) {}
void addField(Hash& hash, const glm::mat3& matrix) {
    for (int column = 0; column < 3; ++column) hash.add(matrix[column]);
}
void addField(Hash& hash, const glm::mat4& matrix) {
    for (int column = 0; column < 4; ++column) hash.add(matrix[column]);
}
void addField(Hash& hash, const TextureRef& reference) {
    hash.add(reference.texture);
    addField(hash, reference.uvFromUv);
}
void addField(Hash& hash, const std::optional<PhongMaterial>& phong) {
    hash.add(phong.has_value());
    if (phong) addFields(hash, *phong);
}
void addField(Hash& hash, const std::shared_ptr<const LightProfile>& profile) {
    hash.add(profile != nullptr);
    if (profile) addVector(hash, profile->factors);
}
template <class T>
void addField(Hash& hash, const T& value) {
    if constexpr (std::is_enum_v<T>)
        hash.add(static_cast<int>(value));
    else
        hash.add(value);
}

template <class T>
void addFields(Hash& hash, const T& object) {
    visitFields([&hash](const char*, const auto& value) { addField(hash, value); }, object);
}

// A hint shows in no picture either.
void addInstance(Hash& hash, Instance instance) {
    instance.dynamic = false;
    addFields(hash, instance);
}

}  // namespace

void Hash::add(std::uint64_t value) {
    constexpr std::uint64_t kPrime = 0x100000001b3u;
    state_ = (state_ ^ value) * kPrime;
    state_ ^= state_ >> 29;  // the product alone carries nothing from high bits to low ones
}

void Hash::add(const void* bytes, std::size_t count) {
    const char* from = static_cast<const char*>(bytes);
    for (; count > 0;) {
        std::uint64_t word = 0;
        const std::size_t part = count < 8 ? count : 8;
        std::memcpy(&word, from, part);
        add(word);
        from += part;
        count -= part;
    }
}

void Hash::add(const std::string& text) {
    add(static_cast<std::uint64_t>(text.size()));
    add(text.data(), text.size());
}

void Hash::add(double value) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    add(bits);
}

void Hash::add(const glm::vec2& v) {
    for (int i = 0; i < 2; ++i) add(v[i]);
}
void Hash::add(const glm::vec3& v) {
    for (int i = 0; i < 3; ++i) add(v[i]);
}
void Hash::add(const glm::vec4& v) {
    for (int i = 0; i < 4; ++i) add(v[i]);
}

std::string Hash::hex() const { return fmt::format("{:016x}", state_); }

namespace {

void addLook(Hash& hash, const Scene& scene) {
    for (const Material& material : scene.materials) addFields(hash, material);
    for (const Texture& texture : scene.textures) addTexture(hash, texture);
}

void addLights(Hash& hash, const Scene& scene) {
    for (const Light& light : scene.lights) addFields(hash, light);
    hash.add(scene.sky);
    hash.add(!scene.format.empty());
    if (!scene.environment.used()) return;
    hash.add(scene.environment.rotation);
    hash.add(scene.environment.strength);
    hash.add(scene.environment.image->width);
    addVector(hash, scene.environment.image->radiance);
}

}  // namespace

void addScene(Hash& hash, const Scene& scene) {
    for (const Mesh& mesh : scene.meshes) addMesh(hash, mesh);
    addLook(hash, scene);
    for (const Instance& instance : scene.instances) addInstance(hash, instance);
    addLights(hash, scene);
}

void addStatics(Hash& hash, const Scene& scene) {
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        if (instance.dynamic || !instance.visible) continue;
        hash.add(static_cast<std::uint64_t>(i));
        addFields(hash, instance);
        addMesh(hash, scene.meshes[static_cast<std::size_t>(instance.mesh)]);
    }
    addLook(hash, scene);
    addLights(hash, scene);
}

void addCamera(Hash& hash, const Camera& camera) { addFields(hash, camera); }

}  // namespace conelight::program
