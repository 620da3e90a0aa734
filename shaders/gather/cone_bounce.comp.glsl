#version 450 core
// SPDX-License-Identifier: MIT
// One more bounce: irradiance / pi at every voxel face, by the same cones as pixels use, from the volume as
// it is; the caller rebuilds the volume from it. One invocation per face.
//   CORRECTED  1: what cones miss where light was baked is added (shared/baked_light.h)
#ifndef CORRECTED
#define CORRECTED 0
#endif
layout(local_size_x = 64) in;  // before linear_index, which asks for it
#include "lib/cone_trace.glsl"
#include "lib/lighting.glsl"
#include "lib/linear_index.glsl"
#include "lib/voxel_grid.glsl"
#include "lib/voxel_record.glsl"
#include "shared/irradiance.h"
layout(std430) readonly buffer FaceTable { FaceRecord faces[]; };
layout(std430) buffer LitFaceTable { LitFace litFaces[]; };
#if CORRECTED
#include "shared/baked_light.h"
layout(std430) readonly buffer FaceCorrectionTable { uvec2 faceCorrections[]; };
#endif

void main() {
    uint index = linearIndex();
    bool inside = index < grid.faceCount;
    FaceRecord face = faces[min(index, max(grid.faceCount, 1u) - 1u)];
    vec3 normal = faceNormal(face);
    vec3 origin = worldFromGrid(faceCenter(face)) + cones.offset * normal;
    uint samples;
    ConeReach reach = ConeReach(cones.maxDistance, 0.0);
    vec3 irradiance = gatherCones(origin, normal, inside ? cones.count : 0u, reach, samples).rgb;
    if (!inside) return;
#if CORRECTED
    uvec2 correction = faceCorrections[index];
    irradiance += vec3(unpackHalf2x16(correction.x), unpackHalf2x16(correction.y).x);
    irradiance = max(irradiance, 0.0);
#endif
    // Below the largest half.
    irradiance = min(irradiance, 65000.0);
    litFaces[index].irradiance0 = packHalf2x16(irradiance.rg);
    litFaces[index].irradiance1 = packHalf2x16(vec2(irradiance.b, 0.0)) | FACE_LIT | (1u << FACE_AGE_SHIFT);
}
