// SPDX-License-Identifier: MIT
// Second third of a prefix sum: one group turns the chunks' sums into their starts, and writes the totals and
// the group counts of the passes that follow. STEP 0: no sum,
// group count of surface_tiles. 1: after counting bricks. 2: after counting faces. 3: no sum, group count of
// surface_resolve in an update. 4: no sum, group counts of surface_layers.
#version 450
#ifndef STEP
#error STEP must be 0, 1, 2, 3 or 4
#endif
#if STEP == 1 || STEP == 2
#include "shared/prefix_sum.h"
layout(local_size_x = PREFIX_GROUP) in;
#else
layout(local_size_x = 8) in;
#endif
#include "lib/voxel_grid.glsl"
#include "voxels/surface_common.glsl"
layout(std430) buffer CounterTable { uint counters[]; };
layout(std430) buffer ChunkTable { uvec2 chunks[]; };
#if STEP == 1 || STEP == 2
#define PREFIX_TYPE uvec2
#include "lib/prefix_sum.glsl"
#endif

// Groups of 64 invocations; more than fit along x are folded into y (linearInvocation).
void writeArguments(int at, uint invocations) {
    uint groups = (invocations + 63u) / 64u;
    counters[at] = min(groups, 32768u);
    counters[at + 1] = (groups + 32767u) / 32768u;
    counters[at + 2] = 1u;
}

void main() {
#if STEP == 0 || STEP == 3 || STEP == 4
    if (gl_LocalInvocationIndex != 0u) return;
#endif
#if STEP == 0
    writeArguments(SURFACE_ARGS_TILES, 8u * min(counters[SURFACE_TILES], surface.tileCapacity));
#elif STEP == 3
    writeArguments(SURFACE_ARGS_WORK, min(counters[SURFACE_WORK], surface.faceCapacity));
    uint made = counters[SURFACE_FRAGMENTS];
    counters[SURFACE_SLOTS] = counters[SURFACE_TAIL] + made - min(made, counters[SURFACE_FREE]);
#elif STEP == 4
    writeArguments(SURFACE_ARGS_LAYERS, min(counters[SURFACE_LAYERS], surface.faceCapacity));
    writeArguments(SURFACE_ARGS_WIDE, min(counters[SURFACE_WIDE], surface.faceCapacity));
#else
#if STEP == 1
    uint count = storedBrickCount();
    uint chunkCount = (count + surface.bricksPerChunk - 1u) / surface.bricksPerChunk;
#else
    uint count = min(counters[SURFACE_VOXELS], surface.voxelCapacity);
    uint chunkCount = (count + surface.voxelsPerChunk - 1u) / surface.voxelsPerChunk;
#endif
    uvec2 total = prefixChunks(chunkCount);
    if (gl_LocalInvocationIndex != 0u) return;
#if STEP == 1
    counters[SURFACE_VOXELS] = total.x;
    counters[SURFACE_BRICKS] = total.y;
    uint voxels = min(total.x, surface.voxelCapacity);
    writeArguments(SURFACE_ARGS_BRICKS, min(total.y, surface.brickCapacity));
    writeArguments(SURFACE_ARGS_FRAGMENTS, min(counters[SURFACE_FRAGMENTS], surface.fragmentCapacity));
    writeArguments(SURFACE_ARGS_VOXELS, (voxels + surface.voxelsPerChunk - 1u) / surface.voxelsPerChunk);
#else
    counters[SURFACE_FACES] = total.x;
    writeArguments(SURFACE_ARGS_FACES, min(total.x, surface.faceCapacity));
#endif
#endif
}
