// SPDX-License-Identifier: MIT
// A mesh as the GPU has it, and the boxes of its parts.
#pragma once

#include <cstdint>
#include <vector>

#include "conelight/scene.h"
#include "shared/scene.h"

namespace conelight::scene {

// Of a part of a mesh: large enough that a draw costs little beside its triangles, by eye.
constexpr std::uint32_t kPartIndices = 3 * 256;

// Indices count from its own first vertex.
struct PackedMesh {
    std::vector<gpu::Vertex> vertices;
    std::vector<std::uint32_t> indices;
    std::vector<Aabb> parts;
    std::vector<std::uint32_t> sources;  // the mesh's vertex that each is made of
};

PackedMesh packed(const Mesh& mesh);

}  // namespace conelight::scene
