// SPDX-License-Identifier: MIT
#include "io/upright.h"

namespace conelight::io {
namespace {

// Of the outline seen along the axis, the part between the ends of what the model stands on.
float stance(const Scene& scene, const Aabb& bounds, int axis) {
    constexpr float kLowest = 0.03f;
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const glm::vec3 size = bounds.extent();
    const float top = bounds.min[axis] + kLowest * size[axis];
    Aabb base;
    for (const Instance& instance : scene.instances)
        for (const glm::vec3& position : scene.meshes[static_cast<std::size_t>(instance.mesh)].positions) {
            const glm::vec3 p(instance.worldFromObject * glm::vec4(position, 1));
            if (p[axis] <= top) base.grow(p);
        }
    const glm::vec3 part = base.extent();
    return size[u] * size[v] > 0 ? part[u] * part[v] / (size[u] * size[v]) : 0.0f;
}

}  // namespace

void turnUpright(Scene& scene) {
    const Aabb bounds = scene.bounds();
    if (bounds.empty() || stance(scene, bounds, 1) > 2 * stance(scene, bounds, 2)) return;
    const glm::mat4 yUpFromZUp{1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1};  // (x, y, z) -> (x, z, -y)
    for (Instance& instance : scene.instances)
        instance.worldFromObject = yUpFromZUp * instance.worldFromObject;
    scene.notes.emplace_back("says nothing of its up axis: z was taken");
}

}  // namespace conelight::io
