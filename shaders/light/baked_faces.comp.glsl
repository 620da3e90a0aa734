#version 450 core
// SPDX-License-Identifier: MIT
// Baked light at the faces of any voxels in the grid of those that do not move (oldBricks, oldRecords): a face has
// the irradiance and the correction of the face there that lies in the same voxel and looks the same way, or none.
// One invocation per face.
layout(local_size_x = 64) in;  // before linear_index, which asks for it
#include "lib/linear_index.glsl"
#include "lib/voxel_grid.glsl"
#include "lib/voxel_record.glsl"
#include "shared/baked_light.h"
#include "shared/irradiance.h"
layout(std430) readonly buffer FaceTable { FaceRecord faces[]; };
layout(std430) buffer LitFaceTable { LitFace litFaces[]; };
layout(std430) readonly buffer BakedFaceTable { uvec2 bakedFaces[]; };
layout(std430) readonly buffer BakedCorrectionTable { uvec2 bakedCorrections[]; };
layout(std430) writeonly buffer FaceCorrectionTable { uvec2 faceCorrections[]; };
uniform usampler3D oldBricks;
uniform usamplerBuffer oldRecords;

void main() {
    uint index = linearIndex();
    if (index >= grid.faceCount) return;
    FaceRecord face = faces[index];
    ivec3 voxel = unpackVoxel(face.voxel);
    int direction = sideOfAxis(int(face.voxel >> 30), faceNormal(face));
    uvec4 word = texelFetch(oldBricks, voxel >> 2, 0);
    uint bit = bitOfVoxel(voxel);
    bool occupied = brickHas(word.xy, bit);
    uint record = texelFetch(oldRecords, occupied ? int(voxelRecordIndex(word, bit)) : 0).x;
    bool had = occupied && (faceDirections(record) >> direction & 1u) != 0u;
    uint there = had ? faceIndex(record, direction) : 0u;
    uvec2 baked = had ? bakedFaces[there] : uvec2(0u);
    faceCorrections[index] = had ? bakedCorrections[there] : uvec2(0u);
    if ((baked.y & BAKED_FACE) == 0u) return;
    litFaces[index].irradiance0 = baked.x;
    litFaces[index].irradiance1 = (baked.y & 0xffffu) | FACE_LIT | (1u << FACE_AGE_SHIFT);
}
