// SPDX-License-Identifier: MIT
// A scene's triangles in the world, one after the other.
#pragma once

#include "conelight/scene.h"

namespace conelight::scene {

// Calls `use` with the corners of each triangle of an instance, in the world.
template <class Use>
void forTriangles(const Scene& scene, const Instance& instance, const Use& use) {
    if (!instance.visible || instance.mesh < 0) return;
    const Mesh& mesh = scene.meshes[static_cast<std::size_t>(instance.mesh)];
    const auto corner = [&](std::size_t k) {
        return glm::vec3(instance.worldFromObject * glm::vec4(mesh.positions[mesh.indices[k]], 1));
    };
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) use(corner(i), corner(i + 1), corner(i + 2));
}

// Of all visible ones.
template <class Use>
void forTriangles(const Scene& scene, const Use& use) {
    for (const Instance& instance : scene.instances) forTriangles(scene, instance, use);
}

}  // namespace conelight::scene
