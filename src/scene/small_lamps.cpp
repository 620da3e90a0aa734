// SPDX-License-Identifier: MIT
#include "scene/small_lamps.h"

#include <algorithm>

#include "scene/emissive_boxes.h"
#include "scene/emissive_spheres.h"

namespace conelight::scene {
namespace {

constexpr float kGridEdge = 128;  // voxels of the default grid along the longest axis

}  // namespace

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
