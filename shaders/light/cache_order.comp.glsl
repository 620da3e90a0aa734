#version 450 core
// SPDX-License-Identifier: MIT
// The order in which updates visit faces: by block of 16^3 voxels, direction, place (lib/interleave.glsl),
// brick. Eight neighbours in this order look the same way from places a few voxels apart and share their
// directions (cache_update), so that their rays run side by side; faces next to each other in space do not
// share theirs. A counting sort: a bin per block, direction and place, with a bit for each of the block's 64
// bricks.
//   STEP 0  faces -> bins
//   STEP 1  bins -> number of faces per chunk of bins
//   STEP 2  the same -> faces before each chunk (one invocation)
//   STEP 3  bins -> faces before each bin
//   STEP 4  faces -> order
//   STEP 5  instead of all: faces as they are stored, for grids with too many bins
#ifndef STEP
#error STEP must be 0 to 5
#endif
layout(local_size_x = 64) in;
#include "lib/interleave.glsl"
#include "lib/linear_index.glsl"
#include "lib/voxel_grid.glsl"
#include "lib/voxel_record.glsl"
#include "shared/irradiance.h"
layout(std430, binding = CACHE_ORDER) buffer OrderTable { uint order[]; };
layout(std430, binding = CACHE_BINS) buffer BinTable { uvec2 bins[]; };
layout(std430, binding = CACHE_BIN_STARTS) buffer StartTable { uint starts[]; };
layout(std430, binding = CACHE_CHUNKS) buffer ChunkTable { uint chunks[]; };
layout(binding = UNIT_VOXEL_FACES) uniform usamplerBuffer faces;
layout(binding = CACHE_UNIT_BINS) uniform usamplerBuffer binTexels;
layout(binding = CACHE_UNIT_BIN_STARTS) uniform usamplerBuffer startTexels;

uint binCount() {
    ivec3 blocks = (gridBricks() + 3) >> 2;
    return uint(blocks.x * blocks.y * blocks.z) * CACHE_BINS_PER_BLOCK;
}
uint binsPerChunk() { return (binCount() + CACHE_ORDER_CHUNKS - 1u) / CACHE_ORDER_CHUNKS; }

// The bin of a face; `brick`: its brick in the block.
uint binOf(uvec4 hitTexel, out uint brick) {
    ivec3 voxel = unpackVoxel(hitTexel.w);
    int axis = int(hitTexel.w >> 30);
    vec3 n = octDecode(unpackSnorm2x16(hitTexel.x));
    float along = axis == 0 ? n.x : (axis == 1 ? n.y : n.z);
    ivec3 within = (voxel >> 2) & 3;
    brick = uint(within.x | within.y << 2 | within.z << 4);
    uint block = brickIndex(voxel >> 4, (gridBricks() + 3) >> 2);
    return block * CACHE_BINS_PER_BLOCK + uint(2 * axis + (along < 0.0 ? 1 : 0)) * 64u +
           bitOfVoxel(ivec3(interleavedPlace(uvec3(voxel), uint(axis))));
}

void main() {
    uint index = linearIndex();
#if STEP == 5
    if (index < grid.faceCount) order[index] = index;
#elif STEP == 0 || STEP == 4
    if (index >= grid.faceCount) return;
    uint brick;
    uint bin = binOf(texelFetch(faces, 2 * int(index)), brick);
#if STEP == 0
    if (brick < 32u)
        atomicOr(bins[bin].x, 1u << brick);
    else
        atomicOr(bins[bin].y, 1u << (brick - 32u));
#else
    uint before = texelFetch(startTexels, int(bin)).x;
    order[before + brickRank(texelFetch(binTexels, int(bin)).xy, brick)] = index;
#endif
#elif STEP == 2
    uint before = 0u;
    uint i = 0u;
    bool first = index == 0u;
    do {
        uint count = chunks[i];
        if (first) chunks[i] = before;
        before += count;
    } while (++i < CACHE_ORDER_CHUNKS);
#else
    uint size = binsPerChunk();
    uint bin = min(index * size, binCount());
    uint end = index < CACHE_ORDER_CHUNKS ? min(bin + size, binCount()) : bin;
    uint sum = STEP == 3 && index < CACHE_ORDER_CHUNKS ? chunks[index] : 0u;
    while (bin < end) {
        uvec2 mask = texelFetch(binTexels, int(bin)).xy;
#if STEP == 3
        starts[bin] = sum;
#endif
        sum += uint(bitCount(mask.x) + bitCount(mask.y));
        ++bin;
    }
#if STEP == 1
    if (index < CACHE_ORDER_CHUNKS) chunks[index] = sum;
#endif
#endif
}
