// SPDX-License-Identifier: MIT
// Seams of light maps: what two charts show along an edge that they share is made the same.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "reference/lightmap_charts.h"

namespace conelight::reference {

// Moves texels of a map of `size`, row by row, by as little as makes bilinear lookups on both sides of all seams
// agree, by least squares (Iwanicki 2013, "Lighting Technology of The Last of Us"). `seams` in texels of the map.
void stitchSeams(std::vector<glm::vec3>& texels, const glm::ivec2& size, const std::vector<Seam>& seams);

// Bilinear, at `at` texels from the first one's corner, within the map.
glm::vec3 bilinear(const std::vector<glm::vec3>& texels, const glm::ivec2& size, const glm::vec2& at);

}  // namespace conelight::reference
