// SPDX-License-Identifier: MIT
// What the pixels' centres see, by rays against the triangles: numbers of instances, materials and triangles,
// positions, normals, texture coordinates. Scene + camera -> tables, one row per pixel, first row on top.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "conelight/scene.h"
#include "reference/ray_scene.h"

namespace conelight::python {

struct SurfaceTables {
    std::vector<std::int32_t> instance, material, triangle;  // -1: nothing; of material also: the default one
    std::vector<float> depth;                                // along the view, m
    std::vector<glm::vec3> position, geometricNormal, normal;
    std::vector<glm::vec2> uv;
    std::vector<glm::vec3> baseColor;
    std::vector<float> metallic, roughness;
    std::vector<glm::vec2> motion;  // empty without SeenBefore
    explicit SurfaceTables(std::size_t pixels);
};

// The picture before: fills `motion`, where a pixel's surface point was in it less where it is now, in pixels, x to the
// right, y down. Its scene has the same instances, and meshes of as many vertices.
struct SeenBefore {
    const Scene& scene;
    Camera camera;
};
// Throws Error(Usage) when the scene before has not the same instances.
void checkSeenBefore(const Scene& scene, const SeenBefore& before);

// `threads`: 0 for all cores. `before`: null, or as checkSeenBefore wants it.
SurfaceTables surfacesOf(const Scene& scene, const reference::RayScene& rays, const Camera& camera,
                         const glm::ivec2& size, int threads, const SeenBefore* before = nullptr);

}  // namespace conelight::python
