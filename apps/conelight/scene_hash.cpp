// SPDX-License-Identifier: MIT
#include "scene_hash.h"

#include <fmt/core.h>

#include <cstring>

namespace conelight::program {
namespace {

template <class T>
void addVector(Hash& hash, const std::vector<T>& values) {
    hash.add(static_cast<std::uint64_t>(values.size()));
    hash.add(values.data(), values.size() * sizeof(T));
}

void addReference(Hash& hash, const TextureRef& reference) {
    hash.add(reference.texture);
    for (int column = 0; column < 3; ++column) hash.add(reference.uvFromUv[column]);
}

void addMesh(Hash& hash, const Mesh& mesh) {
    addVector(hash, mesh.positions);
    addVector(hash, mesh.normals);
    addVector(hash, mesh.uvs);
    addVector(hash, mesh.tangents);
    addVector(hash, mesh.colors);
    addVector(hash, mesh.indices);
}

void addMaterial(Hash& hash, const Material& m) {
    const PhongMaterial phong = m.phong.value_or(PhongMaterial{});
    hash.add(m.baseColor);
    hash.add(m.specularColor);
    hash.add(m.emission);
    for (const float value :
         {m.metallic, m.roughness, m.ior, m.specular, m.normalScale, m.alphaCutoff, phong.shininess,
          phong.ambientStrength, phong.diffuseStrength, phong.specularStrength})
        hash.add(value);
    hash.add(phong.color);
    hash.add(static_cast<int>(m.alphaMode));
    for (const bool value : {m.doubleSided, m.unlit, m.phong.has_value()}) hash.add(value);
    for (const TextureRef* reference : {&m.baseColorTexture, &m.metallicRoughnessTexture, &m.normalTexture,
                                        &m.emissiveTexture, &m.specularTexture, &m.specularColorTexture})
        addReference(hash, *reference);
}

void addTexture(Hash& hash, const Texture& texture) {
    for (const int value :
         {texture.width, texture.height, static_cast<int>(texture.srgb), static_cast<int>(texture.wrapU),
          static_cast<int>(texture.wrapV), static_cast<int>(texture.filter)})
        hash.add(value);
    addVector(hash, texture.rgba);
}

void addInstance(Hash& hash, const Instance& instance) {
    hash.add(instance.mesh);
    hash.add(instance.material);
    for (int column = 0; column < 4; ++column) hash.add(instance.worldFromObject[column]);
    for (const bool value : {instance.visible, instance.voxelized, instance.castsShadow}) hash.add(value);
}

void addLight(Hash& hash, const Light& light) {
    hash.add(static_cast<int>(light.type));
    for (const glm::vec3& value :
         {light.intensity, light.position, light.direction, light.halfU, light.halfV, light.falloff})
        hash.add(value);
    for (const float value : {light.innerAngle, light.outerAngle, light.range}) hash.add(value);
    for (const bool value : {light.enabled, light.castsShadow, light.customFalloff}) hash.add(value);
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

void addScene(Hash& hash, const Scene& scene) {
    for (const Mesh& mesh : scene.meshes) addMesh(hash, mesh);
    for (const Material& material : scene.materials) addMaterial(hash, material);
    for (const Texture& texture : scene.textures) addTexture(hash, texture);
    for (const Instance& instance : scene.instances) addInstance(hash, instance);
    for (const Light& light : scene.lights) addLight(hash, light);
    hash.add(scene.sky);
    hash.add(!scene.format.empty());
}

void addCamera(Hash& hash, const Camera& camera) {
    for (const glm::vec3& value : {camera.eye, camera.target, camera.up}) hash.add(value);
    for (const float value : {camera.fovY, camera.zNear, camera.zFar}) hash.add(value);
}

}  // namespace conelight::program
