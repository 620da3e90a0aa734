// SPDX-License-Identifier: MIT
// Vertices of a mesh -> vertices of shared/scene.h: packed normals, tangents and colours. Missing normals are
// flat, which splits vertices: area-weighted smooth ones would hide hard edges.
#pragma once

#include <vector>

#include "conelight/scene.h"
#include "shared/scene.h"

namespace conelight::scene {

// Whether 8 bits do not hold the colours of a mesh: brighter than 1, or finer, as baked light is. Opacity
// has no place beside the shared exponent.
bool hasWideColors(const Mesh& mesh);

// Appends a mesh; returns false when its vertices were split (so that its indices are 0, 1, 2 ...).
bool appendVertices(const Mesh& mesh, std::vector<gpu::Vertex>& vertices);

}  // namespace conelight::scene
