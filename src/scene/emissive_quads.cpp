// SPDX-License-Identifier: MIT
#include "scene/emissive_quads.h"

#include <algorithm>
#include <cmath>

namespace conelight::scene {
namespace {

struct Parallelogram {
    std::array<glm::vec3, 4> corners;  // in order around it, counter-clockwise from the front
};

// The parallelogram that two triangles make up, or nothing.
std::optional<Parallelogram> parallelogramOf(const std::array<glm::vec3, 6>& p, float size) {
    const auto same = [&](const glm::vec3& a, const glm::vec3& b) {
        return glm::length(a - b) <= 1e-5f * size;
    };

    // Turn both so that a, b, c and c, d, a: the diagonal is shared, in opposite directions.
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) {
            const glm::vec3 a = p[i], b = p[(i + 1) % 3], c = p[(i + 2) % 3];
            if (!same(p[3 + j], c) || !same(p[3 + (j + 2) % 3], a)) continue;
            const glm::vec3 d = p[3 + (j + 1) % 3];
            // Opposite sides are equal (which makes it flat as well), and it has an area.
            const bool equalSides = glm::length((b - a) - (c - d)) <= 1e-4f * size;
            const bool hasArea = glm::length(glm::cross(b - a, d - a)) > 1e-6f * size * size;
            if (equalSides && hasArea) return Parallelogram{{a, b, c, d}};
        }
    return std::nullopt;
}

// The object's parallelogram placed in the world, as a light that shines from its front.
Light rectLight(const Parallelogram& quad, const Instance& instance, const Material& material) {
    std::array<glm::vec3, 4> w;
    for (std::size_t i = 0; i < 4; ++i)
        w[i] = glm::vec3(instance.worldFromObject * glm::vec4(quad.corners[i], 1));
    Light light;
    light.name = instance.name;
    light.type = LightType::Rect;
    light.intensity = material.emission;
    light.position = 0.25f * (w[0] + w[1] + w[2] + w[3]);
    light.halfU = 0.5f * (w[1] - w[0]);
    light.halfV = 0.5f * (w[3] - w[0]);
    // A mirrored instance is turned inside out: its front stays the side from which the object's was seen.
    const float side = glm::determinant(glm::mat3(instance.worldFromObject)) < 0 ? -1.0f : 1.0f;
    light.direction = glm::normalize(glm::cross(light.halfU, light.halfV)) * side;
    return light;
}

std::optional<Light> lightOf(const Mesh& mesh, const Instance& instance, const Material& material) {
    if (mesh.indices.size() != 6) return std::nullopt;
    std::array<glm::vec3, 6> corners;
    for (std::size_t i = 0; i < 6; ++i) corners[i] = mesh.positions[mesh.indices[i]];
    return quadLight(corners, glm::length(mesh.bounds().extent()), instance, material);
}

}  // namespace

std::optional<Light> quadLight(const std::array<glm::vec3, 6>& corners, float size, const Instance& instance,
                               const Material& material) {
    const std::optional<Parallelogram> quad = parallelogramOf(corners, size);
    if (!quad) return std::nullopt;
    const Light light = rectLight(*quad, instance, material);
    const bool flat = !(glm::length(glm::cross(light.halfU, light.halfV)) > 0);  // by the scale
    return flat ? std::nullopt : std::optional(light);
}

bool isPlainEmitter(const Scene& scene, const Instance& instance) {
    if (!instance.visible || instance.material < 0) return false;
    const Material& material = scene.materials[static_cast<std::size_t>(instance.material)];
    const bool emits = material.emission.r + material.emission.g + material.emission.b > 0;
    return emits && !material.unlit && !material.emissiveTexture.used() &&
           material.alphaMode != AlphaMode::Mask;
}

std::vector<EmissiveQuad> emissiveQuads(const Scene& scene) {
    std::vector<EmissiveQuad> quads;
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        if (!isPlainEmitter(scene, instance)) continue;
        const Material& material = scene.materials[static_cast<std::size_t>(instance.material)];
        const std::optional<Light> light =
            lightOf(scene.meshes[static_cast<std::size_t>(instance.mesh)], instance, material);
        if (!light) continue;
        quads.push_back({i, *light});
        if (!material.doubleSided) continue;
        quads.push_back(quads.back());
        quads.back().light.direction = -quads.back().light.direction;
    }
    return quads;
}

}  // namespace conelight::scene
