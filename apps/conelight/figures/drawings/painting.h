// SPDX-License-Identifier: MIT
// A picture made by code, and what textures do with pictures: levels, sampling between texels.
#pragma once

#include <vector>

#include "io/image_file.h"

#include <glm/glm.hpp>

namespace conelight::figures {

// Linear colours, rows from the top.
struct Painting {
    int width = 0, height = 0;
    std::vector<glm::dvec3> pixels;
    const glm::dvec3& at(int x, int y) const;  // clamped to the edge
};

// Hills by a lake in evening light, `size` x `size`.
Painting paintLandscape(int size);

// Levels: the picture, then each of half the edge, down to one pixel; a texel is the mean of four.
std::vector<Painting> levelsOf(Painting painting);

// (u,v) in 0..1, from the upper left.
glm::dvec3 nearest(const Painting& painting, glm::dvec2 uv);
glm::dvec3 bilinear(const Painting& painting, glm::dvec2 uv);
// Between two levels; `level` 0 is the first.
glm::dvec3 trilinear(const std::vector<Painting>& levels, glm::dvec2 uv, double level);

io::ByteImage bytesOf(const Painting& painting);  // sRGB

}  // namespace conelight::figures
