#version 450 core
// SPDX-License-Identifier: MIT
// After voxels were built anew: each face takes over the state of the face that lay where its voxel's centre
// is, and looked in the same direction; else of the same voxel's face in any other direction nothing: it
// starts dark. Counts of rays for dead faces are halved, so that what has moved is found again.
layout(local_size_x = 64) in;
#include "lib/linear_index.glsl"
#include "lib/voxel_grid.glsl"
#include "lib/voxel_record.glsl"
#include "shared/irradiance.h"
layout(std140, binding = BINDING_PASS) uniform CarryBlock { CacheCarry carry; };
layout(std430, binding = CACHE_STATE) writeonly buffer StateTable { FaceCache states[]; };
layout(std430, binding = CACHE_OLD_STATE) readonly buffer OldTable { FaceCache oldStates[]; };
layout(binding = UNIT_VOXEL_FACES) uniform usamplerBuffer faces;
layout(binding = CACHE_UNIT_OLD_BRICKS) uniform usampler3D oldBricks;
layout(binding = CACHE_UNIT_OLD_RECORDS) uniform usamplerBuffer oldRecords;

void main() {
    uint index = linearIndex();
    bool used = index < grid.faceCount;
    uvec4 r = texelFetch(faces, int(used ? index : 0u) * 2);
    vec3 n = octDecode(unpackSnorm2x16(r.x));
    int axis = int(r.w >> 30);
    float along = axis == 0 ? n.x : (axis == 1 ? n.y : n.z);
    int direction = 2 * axis + (along < 0.0 ? 1 : 0);
    vec3 world = worldFromGrid(vec3(unpackVoxel(r.w)) + 0.5);
    ivec3 voxel = ivec3(floor((world - carry.oldOrigin) * carry.oldInverseVoxelSize));
    bool inside = all(greaterThanEqual(voxel, ivec3(0))) &&
                  all(lessThan(voxel, ivec3(carry.oldSizeX, carry.oldSizeY, carry.oldSizeZ)));
    voxel = inside ? voxel : ivec3(0);
    uvec4 word = texelFetch(oldBricks, voxel >> 2, 0);
    bool had = inside && brickHas(word.xy, bitOfVoxel(voxel));
    uint record = texelFetch(oldRecords, had ? int(voxelRecordIndex(word, bitOfVoxel(voxel))) : 0).x;
    had = had && (faceDirections(record) >> direction & 1u) != 0u;
    FaceCache state = oldStates[had ? faceIndex(record, direction) : 0u];
    uint rays = (state.counts >> 17) & 0x7fu;
    uint backs = (state.counts >> 25) & 0x7fu;
    state.counts = (state.counts & 0xffffu) | (rays << 16) | (backs << 24);
    if (!had) state = FaceCache(vec3(0.0), 0u);
    if (used) states[index] = state;
}
