// SPDX-License-Identifier: MIT
// Which parts of a mesh are closed solids, and how thick they are. No ray from elsewhere sees their insides, though
// exporters like to give them two sides. docs/theory/2_voxels.md, "Insides of solids".
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "conelight/scene.h"

namespace conelight::scene {

// For each position the thickness of the connected part whose triangles (three indices each) name it, in the units of
// the positions: four times its volume over its area. That is the diameter of a long rod, and twice the thickness of a
// board. Negative: the part is open, or its triangles look inwards, or no triangle names it. Positions are one where
// they differ by less than half a millionth of the largest coordinate: vertices are split along seams. A part is closed where
// each of its edges is walked as often one way as the other.
std::vector<float> solidThickness(const std::vector<glm::vec3>& positions,
                                  const std::vector<std::uint32_t>& indices);

// A thickness rounded up to a power of two, as VERTEX_SOLID_BITS count it; 0: open, or too thick.
std::uint8_t solidCode(float thickness);

// Of each vertex of a mesh.
std::vector<std::uint8_t> solidCodes(const Mesh& mesh);

}  // namespace conelight::scene
