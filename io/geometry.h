// SPDX-License-Identifier: MIT
// Repairs that importers share: normals, tangents, mirrored instances. All deterministic.
#pragma once

#include "conelight/scene.h"

namespace conelight::io {

// Gives every triangle its own three vertices and the normal of its plane; other attributes are kept.
void makeFlatNormals(Mesh& mesh);

// Scales normals to unit length; one that is zero or not finite becomes the area-weighted mean of its
// triangles. Returns how many were replaced.
std::size_t repairNormals(Mesh& mesh);

// Tangents along increasing u from positions, normals and uvs (Lengyel's per-triangle directions, weighted by
// corner angle as in Mikkelsen 2008). Vertices where texture space is mirrored are split. Missing normals
// are made flat first; does nothing without uvs.
void makeTangents(Mesh& mesh);

// Replaces instances whose transform mirrors (negative determinant) by a mirrored copy of their mesh and a
// transform that does not, so that counter-clockwise stays the front everywhere. Drops instances with a
// singular or non-finite transform. Adds a note for the latter. Returns what each kept instance was.
struct KeptInstance {
    std::size_t before = 0;  // its index
    bool mirrored = false;
    int mesh = -1;  // before it was mirrored
};
std::vector<KeptInstance> removeMirrors(Scene& scene);

}  // namespace conelight::io
