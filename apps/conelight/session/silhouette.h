// SPDX-License-Identifier: MIT
// Pixels that objects cover in a picture, also behind others, and the lines round them. Triangles are drawn on the CPU,
// a pixel by its centre; a vertex covers its pixel, so that nothing is too small to be found.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "conelight/scene.h"

namespace conelight::program {

struct Silhouette {
    int width = 0, height = 0;
    std::vector<std::uint32_t> object;  // the nearest of those given, from 1 on; 0: none. First row on top
};
Silhouette silhouetteOf(const Scene& scene, const std::vector<std::size_t>& instances, const Camera& camera,
                        int width, int height);
// RGBA bytes: the colour, opaque beside an object that comes later or stands alone, fading out over two pixels; else
// transparent.
std::vector<std::uint8_t> outlineOf(const Silhouette& silhouette, const glm::u8vec3& color);

}  // namespace conelight::program
