// SPDX-License-Identifier: MIT
// What a host's shader does with light maps, and the picture that comes of it.
#include <algorithm>

#include "reference/lightmap_seams.h"
#include "reference/lightmaps.h"

namespace conelight::reference {

glm::vec3 irradianceAt(const Scene& scene, const LightmapLayout& layout, const std::vector<Lightmap>& maps,
                       const RayHit& hit, const glm::vec3& shadingNormal, bool directional) {
    const LightmapPlace& place = layout.places[hit.instance];
    if (place.map < 0) return glm::vec3(0);
    const ChartedMesh& mesh = layout.meshes[static_cast<std::size_t>(scene.instances[hit.instance].mesh)];
    const Lightmap& map = maps[static_cast<std::size_t>(place.map)];
    const std::size_t i = 3 * static_cast<std::size_t>(hit.triangle);
    const auto corner = [&](std::size_t k) { return mesh.uvs[mesh.mesh.indices[i + k]]; };
    const glm::vec2 b = hit.barycentric;
    const glm::vec2 at =
        glm::vec2(place.offset) + corner(0) * (1 - b.x - b.y) + corner(1) * b.x + corner(2) * b.y;
    const glm::vec3 irradiance = bilinear(map.irradiance, map.size, at);
    if (!directional) return irradiance;
    constexpr float kLeast = 0.05f;
    const glm::vec3 direction = bilinear(map.direction, map.size, at);
    const auto facing = [&](const glm::vec3& normal) { return 0.5f + 0.5f * glm::dot(normal, direction); };
    return irradiance * (facing(shadingNormal) / std::max(facing(pointAt(scene, hit).normal), kLeast));
}

BakedPicture drawWithLightmaps(const Scene& scene, const LightmapLayout& layout,
                               const std::vector<Lightmap>& maps, bool directional, const Camera& camera,
                               const PathTracedPicture& truth) {
    return drawWithIrradiance(scene, camera, truth, [&](const Surface& surface, const RayHit& hit) {
        return irradianceAt(scene, layout, maps, hit, surface.shadingNormal, directional);
    });
}

}  // namespace conelight::reference
