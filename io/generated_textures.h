// SPDX-License-Identifier: MIT
// Small textures made by code: stone blocks, floor tiles, plaster, marble, fabric, wood. All tile without a
// seam, are square, and are built from periodic gradient noise (Perlin, "An Image Synthesizer", 1985) on
// hashed lattices: no state, the same size gives the same bytes.
#pragma once

#include "conelight/scene.h"

#include <cstdint>

namespace conelight::io::textures {

// Gradient noise over the unit square, repeating with period 1: `cells` lattice cells across; about [-0.7,
// 0.7].
float noise(glm::vec2 uv, int cells, std::uint32_t seed);
// Octaves of it, each twice as fine and half as strong; about [-1, 1].
float fractalNoise(glm::vec2 uv, int cells, int octaves, std::uint32_t seed);

// A look made of up to three textures. Unused ones have width 0.
struct Surface {
    Texture color;      // sRGB
    Texture normal;     // tangent space, green points to the upper rows
    Texture roughness;  // in g, as Material::metallicRoughnessTexture takes it; blue (metallic) is 255
};

// Limestone ashlar in running bond: four courses, two blocks each.
Surface ashlar(int size);
// Two by two polished tiles, light and dark in turn, with rough joints. The roughness texture scales 1.
Surface tiles(int size);

// Grey-scale variations around white, to be multiplied with a material's colour.
Texture plaster(int size);
Texture marble(int size);
Texture fabric(int size);  // weave with rings woven in
Texture wood(int size);    // grain along v

}  // namespace conelight::io::textures
