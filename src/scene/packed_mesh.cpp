// SPDX-License-Identifier: MIT
#include "scene/packed_mesh.h"

#include <numeric>

#include "scene/closed_solids.h"
#include "scene/gpu_vertices.h"
#include "scene/mesh_order.h"

namespace conelight::scene {
namespace {

void markSolids(PackedMesh& mesh) {
    std::vector<glm::vec3> positions;
    positions.reserve(mesh.vertices.size());
    for (const gpu::Vertex& vertex : mesh.vertices) positions.push_back(vertex.position);
    const std::vector<float> thickness = solidThickness(positions, mesh.indices);
    for (std::size_t i = 0; i < thickness.size(); ++i) mesh.vertices[i].tangentOct |= solidBits(thickness[i]);
}

}  // namespace

PackedMesh packed(const Mesh& mesh) {
    PackedMesh to;
    const bool whole = appendVertices(mesh, to.vertices);
    if (whole) {
        to.indices = mesh.indices;
    } else {
        to.indices.resize(mesh.indices.size());
        std::iota(to.indices.begin(), to.indices.end(), 0u);
    }
    markSolids(to);
    to.sources = orderForReuse(to.vertices, 0, to.indices, 0);
    if (!whole)
        for (std::uint32_t& source : to.sources) source = mesh.indices[source];
    for (std::size_t i = 0; i < to.indices.size(); ++i) {
        if (i % kPartIndices == 0) to.parts.emplace_back();
        to.parts.back().grow(to.vertices[to.indices[i]].position);
    }
    return to;
}

}  // namespace conelight::scene
