#version 450 core
// SPDX-License-Identifier: MIT
// The order in which updates visit faces, those that gather: by block of 16^3 voxels, direction, place
// (lib/interleave.glsl), brick. Eight neighbours in this order look the same way from places a few voxels
// apart and share their directions (cache_update), so that their rays run side by side; faces next to each
// other in space do not share theirs. A counting sort: a bin per block, direction and place, with a bit for
// each of the block's 64 bricks. Faces that hold the surface of another one of their voxel do not gather;
// they get its number (docs/theory/4d_cache.md, "One surface, one mean"). Nor do those inside closed objects.
// Faces that may be, or no longer be, inside of one are visited last, to be looked at: a half of them after
// each sort.
//   STEP 0  faces that gather -> bins; those that share -> states
//   STEP 1  bins -> number of faces per chunk of bins
//   STEP 2  the same -> faces before each chunk, and at all (one group)
//   STEP 3  bins -> faces before each bin
//   STEP 4  faces that gather -> order
// Grids with many blocks are sorted in sweeps, so many blocks at a time: all steps for each. Doubtful faces are listed in
// the last one.
#ifndef STEP
#error STEP must be 0 to 4
#endif
#if STEP == 2
#include "shared/prefix_sum.h"
layout(local_size_x = PREFIX_GROUP) in;
#else
layout(local_size_x = 64) in;
#endif
#include "lib/dot.glsl"
#include "lib/interleave.glsl"
#include "lib/linear_index.glsl"
#include "lib/voxel_grid.glsl"
#include "lib/voxel_record.glsl"
#include "light/cache_state.glsl"
layout(std430) buffer OrderTable { uint order[]; };
layout(std430) buffer BinTable { uvec2 bins[]; };
layout(std430) buffer StartTable { uint starts[]; };
// Of each chunk of bins; in front of them the faces that gather, how many doubtful ones follow, and the faces that gather
// of the sweeps before.
layout(std430) buffer ChunkTable {
    uint gathering;
    uint doubtful;
    uint sortedBefore;
    uint chunks[];
};
#if STEP == 2
#define PREFIX_TYPE uint
#include "lib/prefix_sum.glsl"
#endif
#if STEP == 0
layout(std430) writeonly buffer StateTable { uvec4 states[]; };
#endif
layout(std140) uniform OrderBlock { CacheOrder settings; };
uniform usamplerBuffer stateTexels;
uniform usamplerBuffer voxelFaces;
uniform usamplerBuffer binTexels;
uniform usamplerBuffer startTexels;

// Two faces of one voxel hold the same surface when the cosine between their normals is above the first, and
// their planes and the middles of their bounds are no farther apart than this, in voxels.
const float kSameSurfaceNormal = 0.92;
const float kSameSurfaceOffset = 0.25;
const float kSameSurfaceAside = 0.35;
// One that covers less than this part of the other, and is turned from it by no more than this cosine, is a
// sliver: what it gathered would be next to nothing of what is looked up there.
const float kSliverPart = 0.1;
const float kSliverNormal = 0.5;

// Which face gathers for this one: that of its voxel which looks where the normal leans most, if it gathers
// for itself and holds the same surface, or nearly all of it; else this one.
uint gathererOf(uint face, uvec4 hitTexel) {
    vec3 n = octDecode(unpackSnorm2x16(hitTexel.x));
    int wanted = mainDirection(n);
    int direction = faceDirection(hitTexel, n);
    // Faces of a voxel are stored side by side, by direction.
    int step = wanted < direction ? -1 : 1;
    int last = int(grid.faceCount) - 1;
    int at = int(face);
    uvec4 r = hitTexel;
    bool found = false;
    int left = abs(wanted - direction);
    while (left > 0) {
        at = clamp(at + step, 0, last);
        r = texelFetch(voxelFaces, at);
        bool here = ((r.w ^ hitTexel.w) & 0x3fffffffu) == 0u;
        found = here && faceDirection(r, octDecode(unpackSnorm2x16(r.x))) == wanted;
        left = here && !found ? left - 1 : 0;
    }
    vec3 turned = octDecode(unpackSnorm2x16(r.x));
    vec3 aside = unpackBoundsMin(r.z) + unpackBoundsMax(r.z) - unpackBoundsMin(hitTexel.z) -
                 unpackBoundsMax(hitTexel.z);
    bool same = dot(n, turned) > kSameSurfaceNormal &&
                abs(unpackOffset(r.y) - unpackOffset(hitTexel.y)) < kSameSurfaceOffset &&
                0.5 * length(aside) < kSameSurfaceAside;
    bool sliver =
        dot(n, turned) > kSliverNormal && unpackWeight(hitTexel.y) < kSliverPart * unpackWeight(r.y);
    bool shares = found && mainDirection(turned) == wanted && (same || sliver) &&
                  ((r.z ^ hitTexel.z) & FACE_REVERSE) == 0u;
    return shares ? uint(at) : face;
}

// The bin of a face among those of the sweep, or one behind them; `brick`: its brick in the block.
uint binOf(uvec4 hitTexel, out uint brick) {
    ivec3 voxel = unpackVoxel(hitTexel.w);
    int axis = int(hitTexel.w >> 30);
    vec3 n = octDecode(unpackSnorm2x16(hitTexel.x));
    ivec3 within = (voxel >> 2) & 3;
    brick = uint(within.x | within.y << 2 | within.z << 4);
    uint block = brickIndex(voxel >> 4, (gridBricks() + 3) >> 2);
    return (block - settings.firstBlock) * CACHE_BINS_PER_BLOCK + uint(faceDirection(hitTexel, n)) * 64u +
           bitOfVoxel(ivec3(interleavedPlace(uvec3(voxel), uint(axis))));
}

// What becomes of a face that does not share, by its state.
const uint kGathers = 0u;
const uint kDoubtful = 1u;
const uint kLeftOut = 2u;
uint roleOf(uvec4 hitTexel, uvec4 state) {
    bool dead = isInterior(unpackState(state));
    // Something was met from behind. Whoever gathers shows that in vain, or is about to.
    bool doubtful = dead || 8u * (state.w >> 24) > (state.w >> 16 & 0xffu);
    ivec3 voxel = unpackVoxel(hitTexel.w);
    bool due = ((uint(voxel.x + voxel.y + voxel.z) + settings.number) & 1u) == 0u;
    return doubtful && due && settings.searches != 0u ? kDoubtful : (dead ? kLeftOut : kGathers);
}

#if STEP == 0 || STEP == 4
// A face that gathers goes to its bin, or from there into the order; one that shares learns who gathers for
// it.
void sortFace(uint index) {
    uvec4 hitTexel = texelFetch(voxelFaces, int(index));
    uvec4 state = texelFetch(stateTexels, int(index));
    uint brick;
    uint bin = binOf(hitTexel, brick);
    bool ofSweep = bin < settings.binCount;
#if STEP == 0
    if (!ofSweep) return;
    uint gatherer = gathererOf(index, hitTexel);
    bool shares = gatherer != index;
    if (shares) states[index] = uvec4(gatherer, 0u, 0u, CACHE_SHARES);
#else
    bool shares = (state.w & CACHE_SHARES) != 0u;
#endif
    uint role = shares ? kLeftOut : roleOf(hitTexel, state);
#if STEP == 4
    // In no order: what a face gathers does not depend on it.
    if (role == kDoubtful && settings.lastSweep != 0u) order[gathering + atomicAdd(doubtful, 1u)] = index;
#endif
    if (role != kGathers || !ofSweep) return;
#if STEP == 0
    if (brick < 32u)
        atomicOr(bins[bin].x, 1u << brick);
    else
        atomicOr(bins[bin].y, 1u << (brick - 32u));
#else
    uint before = texelFetch(startTexels, int(bin)).x;
    order[before + brickRank(texelFetch(binTexels, int(bin)).xy, brick)] = index;
#endif
}
#endif

#if STEP == 2
// Numbers per chunk -> numbers before each in the sweep, and at all.
void sumChunks() {
    uint total = prefixChunks(settings.chunkCount);
    if (gl_LocalInvocationIndex != 0u) return;
    sortedBefore = settings.firstBlock == 0u ? 0u : gathering;
    gathering = sortedBefore + total;
    doubtful = 0u;
}
#endif

#if STEP == 1 || STEP == 3
// Counts the faces in the bins of a chunk, or numbers on from those before it.
void walkBins(uint chunk) {
    if (chunk >= settings.chunkCount) return;
    uint bin = chunk * settings.binsPerChunk;
    uint end = min(bin + settings.binsPerChunk, settings.binCount);
    uint sum = STEP == 3 ? sortedBefore + chunks[chunk] : 0u;
    while (bin < end) {
        uvec2 mask = texelFetch(binTexels, int(bin)).xy;
#if STEP == 3
        starts[bin] = sum;
#endif
        sum += uint(bitCount(mask.x) + bitCount(mask.y));
        ++bin;
    }
#if STEP == 1
    chunks[chunk] = sum;
#endif
}
#endif

void main() {
#if STEP != 2
    uint index = linearIndex();
#endif
#if STEP == 0 || STEP == 4
    if (index < grid.faceCount) sortFace(index);
#elif STEP == 1 || STEP == 3
    walkBins(index);
#else
    sumChunks();
#endif
}
