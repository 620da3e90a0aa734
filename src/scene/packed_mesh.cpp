// SPDX-License-Identifier: MIT
#include "scene/packed_mesh.h"

#include <numeric>

#include "scene/closed_solids.h"
#include "scene/gpu_vertices.h"
#include "scene/mesh_order.h"

namespace conelight::scene {

PackedMesh packed(const Mesh& mesh) {
    PackedMesh to;
    const bool whole = appendVertices(mesh, to.vertices);
    if (whole) {
        to.indices = mesh.indices;
    } else {
        to.indices.resize(mesh.indices.size());
        std::iota(to.indices.begin(), to.indices.end(), 0u);
    }
    to.sources = orderForReuse(to.vertices, 0, to.indices, 0);
    if (!whole)
        for (std::uint32_t& source : to.sources) source = mesh.indices[source];
    const std::vector<std::uint8_t> solids = solidCodes(mesh);
    for (std::size_t i = 0; i < to.vertices.size(); ++i)
        to.vertices[i].tangentOct |= VERTEX_SOLID_WORD(std::uint32_t{solids[to.sources[i]]});
    for (std::size_t i = 0; i < to.indices.size(); ++i) {
        if (i % kPartIndices == 0) to.parts.emplace_back();
        to.parts.back().grow(to.vertices[to.indices[i]].position);
    }
    return to;
}

}  // namespace conelight::scene
