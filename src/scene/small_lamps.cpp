// SPDX-License-Identifier: MIT
#include "scene/small_lamps.h"

#include <algorithm>

#include "scene/emissive_boxes.h"
#include "scene/emissive_quads.h"
#include "scene/emissive_spheres.h"

namespace conelight::scene {
namespace {

constexpr float kGridEdge = 128;  // voxels of the default grid along the longest axis
constexpr std::size_t kMostEmitters = 64;

}  // namespace

std::vector<std::size_t> possibleLamps(const Scene& scene, std::size_t fewestTriangles,
                                       std::size_t mostTriangles) {
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        if (!isPlainEmitter(scene, instance) || !instance.voxelized || instance.mesh < 0) continue;
        const std::size_t triangles = scene.meshes[static_cast<std::size_t>(instance.mesh)].triangleCount();
        if (triangles >= fewestTriangles && triangles <= mostTriangles) found.push_back(i);
    }
    if (found.size() > kMostEmitters) found.clear();
    return found;
}

std::vector<SmallLamp> smallLamps(const Scene& scene, const Aabb& bounds) {
    std::vector<SmallLamp> lamps;
    if (bounds.empty()) return lamps;
    const glm::vec3 extent = bounds.extent();
    const float voxel = std::max({extent.x, extent.y, extent.z}) / kGridEdge;
    addEmissiveSpheres(scene, voxel, lamps);
    addEmissiveBoxes(scene, voxel, lamps);
    return lamps;
}

std::vector<SmallLamp> smallLamps(const Scene& scene) {
    std::vector<Aabb> boxes;
    for (const Mesh& mesh : scene.meshes) boxes.push_back(mesh.bounds());
    Aabb bounds;
    for (const Instance& instance : scene.instances)
        if (instance.visible && instance.mesh >= 0)
            bounds.grow(boxes[static_cast<std::size_t>(instance.mesh)].transformed(instance.worldFromObject));
    return smallLamps(scene, bounds);
}

}  // namespace conelight::scene
