// SPDX-License-Identifier: MIT
// First third of a prefix sum: each invocation adds up one chunk of consecutive elements.
// OF_BRICKS 1: occupied voxels and occupied bricks, from the masks. 0: faces, from the directions of voxels.
#version 450
#ifndef OF_BRICKS
#error OF_BRICKS must be 0 or 1
#endif
layout(local_size_x = 64) in;
#include "lib/voxel_grid.glsl"
#include "voxels/surface_common.glsl"
layout(std430) readonly buffer CounterTable { uint counters[]; };
layout(std430) readonly buffer MaskTable { uvec2 masks[]; };
layout(std430) readonly buffer ChainTable { uvec2 chains[]; };
layout(std430) writeonly buffer ChunkTable { uvec2 chunks[]; };

void main() {
    uint chunk = linearInvocation();
#if OF_BRICKS
    uint count = storedBrickCount();
    uint perChunk = surface.bricksPerChunk;
#else
    uint count = min(counters[SURFACE_VOXELS], surface.voxelCapacity);
    uint perChunk = surface.voxelsPerChunk;
#endif
    uint i = chunk * perChunk;
    uint end = min(i + perChunk, count);
    uvec2 sum = uvec2(0u);
    while (i < end) {
#if OF_BRICKS
        uvec2 mask = masks[i];
        sum += uvec2(uint(bitCount(mask.x) + bitCount(mask.y)), (mask.x | mask.y) != 0u ? 1u : 0u);
#else
        sum.x += uint(bitCount(chains[i].y & CHAIN_DIRECTIONS));
#endif
        ++i;
    }
    if (chunk * perChunk < count) chunks[chunk] = sum;
}
