#version 450 core
// SPDX-License-Identifier: MIT
// One update of the irradiance cache: each face of the slice gathers with a few rays what other faces showed
// before, and blends it into its mean (docs/theory/4d_cache.md, "The cache"). Rays read the packed irradiance
// of the records, which cache_commit writes afterwards: who comes first does not matter.
//
// FIND_BACK_FACES 1: also counts rays that meet a surface from behind, to find faces inside closed objects.
layout(local_size_x = 64) in;
#define CACHED_PART 1
#define LEARNS_SKY 1
#include "lib/interleave.glsl"
#include "lib/linear_index.glsl"
#include "lib/voxel_light.glsl"
#include "light/cache_state.glsl"
layout(std140) uniform CacheBlock { CacheConstants cache; };
uniform usamplerBuffer order;
uniform usamplerBuffer stateTexels;
layout(std430) writeonly buffer StateTable { FaceCache states[]; };
layout(std430) writeonly buffer GatheredTable { uvec2 gathered[]; };

// Places 0 to 3 along three axes -> 4 x 4 shifts, all of them on any plane along two of the axes.
vec2 spreadPlace(uvec3 place) {
    uvec2 part = (place.xy + place.z) & 3u;
    return vec2((part >> 1 | part << 1) & 3u) * 0.25;
}

void main() {
    uint index = linearIndex();
    bool used = index < cache.faceCount;
    uint place = cache.firstFace + (used ? index : 0u);
    uint face = texelFetch(order, int(place)).x;
    uvec4 r = texelFetch(voxelFaces, int(face));
    FaceRecord record = FaceRecord(r.x, r.y, r.z, r.w);
    vec3 normal = faceNormal(record);
    // Faces keep their directions from one run to the next by voxel and axis, not by number. Those of one
    // place in the bricks of a block share them, and are next to each other in order.
    uint seed = randomHash((r.w & 0xc0000000u) ^ randomHash(cache.seed));
    // Places complement each other, then blocks, then 4^3 blocks.
    uvec3 voxel = uvec3(r.w, r.w >> 10, r.w >> 20) & 1023u;
    vec2 fine = spreadPlace(interleavedPlace(voxel, r.w >> 30)), coarse = spreadPlace(voxel >> 4),
         coarsest = spreadPlace(voxel >> 6);
    float ofPool = fine.x + fine.y / 4.0 + coarse.x / 16.0 + coarse.y / 64.0;
    vec3 shift = vec3(fine + coarse / 4.0 + coarsest / 16.0, ofPool);
    SurfacePoint point = SurfacePoint(rayOrigin(faceCenter(record), normal), normal, normal);
    EstimatorSettings settings = EstimatorSettings(int(cache.cosineRays), int(cache.lightRays),
                                                   int(cache.reflections), cache.fireflyClamp);
#if SKY_GUIDE
    learningRow = used ? skyRowAt(point.origin, normal) : -1;
#endif
    float backFaceShare;
    SequenceState sequence = SequenceState(seed, cache.update, shift, seed);
    vec3 found = estimateIrradiance(point, settings, sequence, backFaceShare);
    if (!used) return;
#if SKY_GUIDE
    endLearning(cache.cosineRays);
#endif
    FaceCache state = unpackState(texelFetch(stateTexels, int(face)));
#if FIND_BACK_FACES
    uint rays = (state.counts >> 16) & 0xffu;
    if (rays + cache.cosineRays < 256u)
        state.counts +=
            (cache.cosineRays << 16) + (uint(backFaceShare * float(cache.cosineRays) + 0.5) << 24);
    // What few rays take for the inside of something holds no light until more rays know better.
    if (looksInterior(state)) found = gatheredCached = returnedCached = vec3(0.0);
#endif
    uint updates = state.counts & CACHE_UPDATES_MASK;
    // (4.13): replaces while bounces travel, then averages, in which the n-th update has a weight like
    // sqrt(n): what came before bounces had settled is soon outweighed.
    uint window = clamp(updates, IRRADIANCE_SETTLE, IRRADIANCE_SETTLE + cache.longestWindow - 1u);
    state.irradiance += (found - state.irradiance) * (1.5 / (float(window - IRRADIANCE_SETTLE) + 1.5));
    state.counts = (state.counts & 0xffff0000u) | min(updates + 1u, CACHE_UPDATES_MASK);
    states[face] = state;
    gathered[face] = uvec2(packRgb9e5(found - gatheredCached), packRgb9e5(returnedCached));
}
