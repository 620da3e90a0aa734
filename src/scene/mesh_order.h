// SPDX-License-Identifier: MIT
// The order of triangles and vertices in the GPU's copy of a mesh: triangles near each other in space follow
// each other, and vertices are numbered as triangles first name them. Drivers keep the last vertices they
// worked out, by their numbers; files list triangles as they please. Which triangles there are and how they
// turn stays.
#pragma once

#include <cstdint>
#include <vector>

#include "shared/scene.h"

namespace conelight::scene {

// `indices` (three per triangle) from `firstIndex` on name `vertices` from `firstVertex` on, counted from
// there. Triangles are sorted by the Morton code of their centre (Morton 1966), ties as they were; vertices
// that none names come last. Returns which vertex each was, counted from `firstVertex`.
std::vector<std::uint32_t> orderForReuse(std::vector<gpu::Vertex>& vertices, std::size_t firstVertex,
                                         std::vector<std::uint32_t>& indices, std::size_t firstIndex);

}  // namespace conelight::scene
