#version 450 core
// SPDX-License-Identifier: MIT
// After voxels were built anew: each face takes over the state of the face that lay where its own centre is,
// or a quarter voxel in front of or behind it, and looked in the same direction; where there was none it
// starts dark. Counts of rays for interior faces are halved once they can be, so that what has moved is found
// again.
layout(local_size_x = 64) in;
#include "lib/linear_index.glsl"
#include "lib/voxel_grid.glsl"
#include "lib/voxel_record.glsl"
#include "light/cache_state.glsl"
#include "shared/irradiance.h"
layout(std140) uniform ReprojectionBlock { CacheReprojection reprojection; };
layout(std430) writeonly buffer StateTable { FaceCache states[]; };
uniform usamplerBuffer oldStates;
uniform usamplerBuffer voxelFaces;
uniform usampler3D oldBricks;
uniform usamplerBuffer oldRecords;
#if NESTED_GRIDS
layout(std140) uniform OldLevelBlock { VoxelLevels oldLevels; };
#endif

// The voxel, as it was stored, that held a point of the world before; whether one did.
ivec3 oldVoxel(vec3 world, out bool inside) {
#if NESTED_GRIDS
    vec3 point = (world - reprojection.oldOrigin) * reprojection.oldInverseVoxelSize;
    ivec3 size = ivec3(oldLevels.sizeX, oldLevels.sizeY, oldLevels.sizeZ);
    ivec3 found = ivec3(0);
    inside = false;
    int level = int(oldLevels.count) - 1;
    do {
        vec4 place = oldLevels.levels[level];
        ivec3 voxel = ivec3(floor((point - place.xyz) / place.w));
        bool holds = all(greaterThanEqual(voxel, ivec3(0))) && all(lessThan(voxel, size));
        found = holds ? voxel + ivec3(0, 0, level * size.z) : found;
        inside = inside || holds;
    } while (--level >= 0);
    return found;
#else
    ivec3 voxel = ivec3(floor((world - reprojection.oldOrigin) * reprojection.oldInverseVoxelSize));
    inside = all(greaterThanEqual(voxel, ivec3(0))) &&
             all(lessThan(voxel, ivec3(reprojection.oldSizeX, reprojection.oldSizeY, reprojection.oldSizeZ)));
    return voxel;
#endif
}

void main() {
    uint index = linearIndex();
    bool used = index < grid.faceCount;
    uvec4 r = texelFetch(voxelFaces, int(used ? index : 0u));
    vec3 n = octDecode(unpackSnorm2x16(r.x));
    int direction = faceDirection(r, n);
    FaceRecord face = FaceRecord(r.x, r.y, r.z, r.w);
#if NESTED_GRIDS
    vec4 place = voxelPlace(r.w);
    vec3 center = place.xyz + clamp(faceCenter(face) - place.xyz, 0.001 * place.w, 0.999 * place.w);
#else
    vec3 corner = vec3(unpackVoxel(r.w));
    vec3 center = corner + clamp(faceCenter(face) - corner, 0.001, 0.999);
#endif
    bool had = false;
    uint record = 0u;
    int attempt = 0;
    do {
        float aside = attempt == 0 ? 0.0 : (attempt == 1 ? 0.25 : -0.25);
#if NESTED_GRIDS
        aside *= place.w;
#endif
        vec3 world = worldFromGrid(center + aside * directionVector(direction));
        bool inside;
        ivec3 voxel = oldVoxel(world, inside);
        voxel = inside ? voxel : ivec3(0);
        uvec4 word = texelFetch(oldBricks, voxel >> 2, 0);
        bool occupied = inside && brickHas(word.xy, bitOfVoxel(voxel));
        record = texelFetch(oldRecords, occupied ? int(voxelRecordIndex(word, bitOfVoxel(voxel))) : 0).x;
        had = occupied && (faceDirections(record) >> direction & 1u) != 0u;
    } while (!had && ++attempt < 3);
    int old = had ? int(faceIndex(record, direction)) : 0;
    uvec4 texel = texelFetch(oldStates, old);
    FaceCache state = unpackState(texelFetch(oldStates, stateOwner(old, texel)));
    uint rays = (state.counts >> 16) & 0xffu;
    uint backs = state.counts >> 24;
    bool enough = rays >= 2u * IRRADIANCE_INTERIOR_RAYS;
    rays = enough ? rays / 2u : rays;
    backs = enough ? (backs + 1u) / 2u : backs;
    state.counts = (state.counts & 0xffffu) | (rays << 16) | (backs << 24);
    if (!had) state = FaceCache(vec3(0.0), 0u);
    if (used) states[index] = state;
}
