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
    explicit SurfaceTables(std::size_t pixels);
};

// `threads`: 0 for all cores.
SurfaceTables surfacesOf(const Scene& scene, const reference::RayScene& rays, const Camera& camera,
                         const glm::ivec2& size, int threads);

}  // namespace conelight::python
