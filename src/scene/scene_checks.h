// SPDX-License-Identifier: MIT
// The rules of Scene::validate for single elements: what changes one of them checks just that one.
// Each throws Error(BadInput) that names the element and what breaks the rule.
#pragma once

#include <cstddef>

#include "conelight/scene.h"

namespace conelight::scene {

// Against the meshes and materials of `scene`; `index` is for the message.
void validateInstance(const Scene& scene, const Instance& instance, std::size_t index);
// Against the textures of `scene`.
void validateMaterial(const Scene& scene, const Material& material);
// `index` is for the message.
void validateMesh(const Mesh& mesh, std::size_t index);
// How far the instances of a mesh reach, were its bounds these.
void validateReaches(const Scene& scene, std::size_t mesh, const Aabb& bounds);
void validateTexture(const Texture& texture);
void validateLight(const Light& light);
void validateGroups(const Scene& scene);
void validateSky(const glm::vec3& sky);
void validateEnvironment(const Environment& environment);
// Against the instances of `scene`.
void validateBakedLight(const Scene& scene, const BakedLight& baked);

}  // namespace conelight::scene
