// SPDX-License-Identifier: MIT
// Normal maps as files hold them -> with normals of unit length. What a mean of normals lacks in length then tells how
// far they spread (docs/theory/5_image.md, "Textures"), and not how the file was compressed.
#pragma once

#include <cstdint>
#include <vector>

#include "conelight/scene.h"

namespace conelight::scene {

// Bytes, four per texel as in Texture::rgba, normal = 2 texel / 255 - 1. Texels of unit length within what 8 bits
// explain keep their bytes, and so do those without a direction.
std::vector<std::uint8_t> unitNormals(const std::vector<std::uint8_t>& rgba);

// Per texture: whether materials use it as a normal map, of the surface or of its coat, and as nothing else.
std::vector<bool> normalMaps(const std::vector<Material>& materials, std::size_t textures);

}  // namespace conelight::scene
