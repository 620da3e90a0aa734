#version 450 core
// SPDX-License-Identifier: MIT
// Baked irradiance of the faces that do not move, less what cones gathered there: how much cones miss, which may be
// below 0. One invocation per face.
layout(local_size_x = 64) in;  // before linear_index, which asks for it
#include "lib/linear_index.glsl"
#include "lib/voxel_grid.glsl"
#include "shared/baked_light.h"
#include "shared/irradiance.h"
layout(std430) readonly buffer LitFaceTable { LitFace litFaces[]; };
layout(std430) readonly buffer BakedFaceTable { uvec2 bakedFaces[]; };
layout(std430) writeonly buffer BakedCorrectionTable { uvec2 bakedCorrections[]; };

void main() {
    uint index = linearIndex();
    if (index >= grid.faceCount) return;
    uvec2 baked = bakedFaces[index];
    LitFace gathered = litFaces[index];
    vec2 rg = unpackHalf2x16(baked.x) - unpackHalf2x16(gathered.irradiance0);
    float b = unpackHalf2x16(baked.y).x - unpackHalf2x16(gathered.irradiance1).x;
    bool isBaked = (baked.y & BAKED_FACE) != 0u;
    bakedCorrections[index] =
        isBaked ? uvec2(packHalf2x16(rg), (packHalf2x16(vec2(b, 0.0)) & 0xffffu) | BAKED_FACE) : uvec2(0u);
}
