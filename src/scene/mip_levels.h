// SPDX-License-Identifier: MIT
// Mip levels of textures: texels -> means of ever larger parts of them, in linear light. Made here and not by the driver:
// drivers round as they like, and a loss at each level darkens what is seen from afar (docs/theory/5_image.md,
// "Textures").
#pragma once

#include <cstdint>
#include <vector>

namespace conelight::scene {

// A level as glTextureSubImage2D takes it: rows of four bytes a texel.
struct MipLevel {
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgba;
};

// Levels 1 to the last, of half the size each, rounded down, as OpenGL counts them. Texels of odd sizes share those
// between them by area. `rgba`: level 0, 4 * width * height bytes. `srgb`: red, green and blue are encoded.
std::vector<MipLevel> smallerLevels(const std::vector<std::uint8_t>& rgba, int width, int height, bool srgb);

}  // namespace conelight::scene
