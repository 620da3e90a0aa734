// SPDX-License-Identifier: MIT
// Helpers of the generated scenes: materials, table entries, transforms, cameras, lights.
#include "generated_scenes.h"

#include <cassert>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace conelight::io::generated {

void Values::set(std::string_view name, double value) {
    for (auto& [known, old] : values_)
        if (known == name) {
            old = value;
            return;
        }
    values_.emplace_back(name, value);
}

double Values::operator[](std::string_view name) const {
    for (const auto& [known, value] : values_)
        if (known == name) return value;
    assert(!"the scene reads a parameter that it does not declare");
    return 0;
}

Material matte(std::string name, glm::vec3 albedo) {
    Material m;
    m.name = std::move(name);
    m.baseColor = glm::vec4(albedo, 1);
    m.specular = 0;
    return m;
}

Material glossy(std::string name, glm::vec3 albedo, float roughness) {
    Material m = matte(std::move(name), albedo);
    m.specular = 1;
    m.roughness = roughness;
    return m;
}

Material metal(std::string name, glm::vec3 f0, float roughness) {
    Material m = glossy(std::move(name), f0, roughness);
    m.metallic = 1;
    return m;
}

Material emitter(std::string name, glm::vec3 radiance) {
    Material m = matte(std::move(name), glm::vec3(0));
    m.emission = radiance;
    return m;
}

int add(Scene& scene, Material material) {
    scene.materials.push_back(std::move(material));
    return int(scene.materials.size()) - 1;
}

int add(Scene& scene, Mesh mesh) {
    scene.meshes.push_back(std::move(mesh));
    return int(scene.meshes.size()) - 1;
}

int add(Scene& scene, Texture texture) {
    scene.textures.push_back(std::move(texture));
    return int(scene.textures.size()) - 1;
}

Instance& place(Scene& scene, int mesh, int material, std::string name, const glm::mat4& worldFromObject) {
    Instance instance;
    instance.name = std::move(name);
    instance.mesh = mesh;
    instance.material = material;
    instance.worldFromObject = worldFromObject;
    scene.instances.push_back(std::move(instance));
    return scene.instances.back();
}

Instance& addPart(Scene& scene, Mesh mesh, std::string name, int material) {
    mesh.name = name;
    const int index = add(scene, std::move(mesh));
    return place(scene, index, material, std::move(name));
}

TextureRef repeat(int texture, float metres) {
    TextureRef ref;
    ref.texture = texture;
    ref.uvFromUv = glm::mat3(1 / metres);
    ref.uvFromUv[2] = glm::vec3(0, 0, 1);
    return ref;
}

Mesh quad(glm::vec3 origin, glm::vec3 edgeU, glm::vec3 edgeV) {
    Mesh mesh;
    shapes::appendQuad(mesh, origin, edgeU, edgeV);
    return mesh;
}

Mesh box(const Aabb& bounds, bool inward) {
    Mesh mesh;
    shapes::appendBox(mesh, bounds, inward);
    return mesh;
}

glm::mat4 translation(glm::vec3 offset) { return glm::translate(glm::mat4(1), offset); }

glm::mat4 turnAboutY(float angle) { return glm::rotate(glm::mat4(1), angle, glm::vec3(0, 1, 0)); }

Camera camera(std::string name, glm::vec3 eye, glm::vec3 target, float fovYDeg) {
    Camera c;
    c.name = std::move(name);
    c.eye = eye;
    c.target = target;
    c.fovY = glm::radians(fovYDeg);
    return c;
}

Light pointLight(std::string name, glm::vec3 position, glm::vec3 intensity) {
    Light light;
    light.name = std::move(name);
    light.type = LightType::Point;
    light.position = position;
    light.intensity = intensity;
    return light;
}

Light sunLight(std::string name, glm::vec3 direction, glm::vec3 irradiance) {
    Light light;
    light.name = std::move(name);
    light.type = LightType::Directional;
    light.direction = glm::normalize(direction);
    light.intensity = irradiance;
    return light;
}

}  // namespace conelight::io::generated
