#version 450 core
// SPDX-License-Identifier: MIT
// After an update: makes the light of all faces together what it will be when all its bounces have settled
// (docs/theory/4d_cache.md, "The balance of light"). An update adds one bounce; where surfaces reflect the part p of the
// light, n of them lack p^n of it.
//   STEP 0  one group per BALANCE_LANES * BALANCE_FACES_OF_LANE faces: what they hold and have gathered -> its sums
//        1  one group: sums of groups -> CacheBalance
//        2  one invocation per face: its mean, times the correction
#include "shared/irradiance.h"
#if STEP == 0
layout(local_size_x = 64) in;
#elif STEP == 1
layout(local_size_x = BALANCE_GROUP) in;
#elif STEP == 2
layout(local_size_x = 64) in;
#else
#error STEP must be 0, 1 or 2
#endif
#include "lib/dot.glsl"
#include "lib/linear_index.glsl"
#include "lib/voxel_grid.glsl"
#include "lib/voxel_record.glsl"
#include "light/cache_state.glsl"
layout(std140) uniform BalanceBlock { CacheBalancing balancing; };
layout(std430) buffer BalanceTable { CacheBalance balance; };
layout(std430) buffer GroupTable { vec4 groupSums[]; };  // three for each group
uniform usamplerBuffer stateTexels;

#if STEP == 2
layout(std430) writeonly buffer StateTable { FaceCache states[]; };

void main() {
    uint face = linearIndex();
    if (face >= grid.faceCount) return;
    uvec4 texel = texelFetch(stateTexels, int(face));
    if ((texel.w & CACHE_SHARES) == 0u)
        states[face].irradiance = uintBitsToFloat(texel.xyz) * balance.correction;
}
#else
struct Sums {
    vec3 cached, fresh, returned;
};

Sums added(Sums a, Sums b) { return Sums(a.cached + b.cached, a.fresh + b.fresh, a.returned + b.returned); }

const uint kLanes = gl_WorkGroupSize.x;
shared vec3 cachedOfLanes[kLanes], freshOfLanes[kLanes], returnedOfLanes[kLanes];

// Sums of all invocations of a group, in order: the same in every run. All call it, once.
Sums sumOfGroup(Sums own) {
    uint lane = gl_LocalInvocationIndex;
    cachedOfLanes[lane] = own.cached;
    freshOfLanes[lane] = own.fresh;
    returnedOfLanes[lane] = own.returned;
    barrier();
    for (uint reach = kLanes / 2u; reach > 0u; reach /= 2u) {
        if (lane < reach) {
            cachedOfLanes[lane] += cachedOfLanes[lane + reach];
            freshOfLanes[lane] += freshOfLanes[lane + reach];
            returnedOfLanes[lane] += returnedOfLanes[lane + reach];
        }
        barrier();
    }
    return Sums(cachedOfLanes[0], freshOfLanes[0], returnedOfLanes[0]);
}
#endif
#if STEP == 0
uniform usamplerBuffer litFaces;
uniform usamplerBuffer voxelFaces;
uniform usamplerBuffer gatheredTexels;

void main() {
    Sums sums = Sums(vec3(0.0), vec3(0.0), vec3(0.0));
    uint group = linearIndex() / BALANCE_LANES;
    uint first = group * BALANCE_LANES * BALANCE_FACES_OF_LANE + gl_LocalInvocationIndex;
    uint i = 0u;
    do {
        uint face = min(first + i * BALANCE_LANES, grid.faceCount - 1u);
        bool counts = first + i * BALANCE_LANES < grid.faceCount;
        uvec4 texel = texelFetch(stateTexels, int(face));
        FaceCache state = unpackState(texel);
        counts = counts && (texel.w & CACHE_SHARES) == 0u && !isInterior(state);
        uvec2 gathered = texelFetch(gatheredTexels, int(face)).xy;
        vec3 weight = unpackAlbedo(texelFetch(litFaces, int(face)).x) *
                      faceFlux(texelFetch(voxelFaces, int(face)), vec3(1.0));
        weight = counts ? weight : vec3(0.0);
        sums = added(sums, Sums(weight * clamp(state.irradiance, 0.0, 65504.0),
                                weight * unpackRgb9e5(gathered.x), weight * unpackRgb9e5(gathered.y)));
    } while (++i < BALANCE_FACES_OF_LANE);
    sums = sumOfGroup(sums);
    if (gl_LocalInvocationIndex != 0u || group >= balancing.groups) return;
    groupSums[3u * group] = vec4(sums.cached, 0.0);
    groupSums[3u * group + 1u] = vec4(sums.fresh, 0.0);
    groupSums[3u * group + 2u] = vec4(sums.returned, 0.0);
}
#elif STEP == 1
void main() {
    Sums sums = Sums(vec3(0.0), vec3(0.0), vec3(0.0));
    for (uint i = gl_LocalInvocationIndex; i < balancing.groups; i += uint(BALANCE_GROUP))
        sums =
            added(sums, Sums(groupSums[3u * i].rgb, groupSums[3u * i + 1u].rgb, groupSums[3u * i + 2u].rgb));
    sums = sumOfGroup(sums);
    if (gl_LocalInvocationIndex != 0u) return;
    if (balancing.weight > 0.0) {
        vec3 seen = mix(sums.cached, balance.cached, balancing.cachedBefore);
        vec3 returned = clamp(sums.returned / max(seen, 1e-20), 0.0, BALANCE_MOST_RETURNED);
        balance.fresh += balancing.weight * (sums.fresh - balance.fresh);
        balance.returned += balancing.weight * (returned - balance.returned);
        vec3 wanted = balance.fresh / (1.0 - balance.returned);
        // So many rounds lack this part of the light, no more: what else differs is noise.
        vec3 lacking = pow(balance.returned, vec3(balancing.rounds));
        vec3 whole = clamp(wanted / max(sums.cached, 1e-20), 1.0 - lacking, 1.0 / (1.0 - lacking));
        whole = mix(vec3(1.0), whole, greaterThan(sums.cached, vec3(1e-20)));
        balance.correction = mix(vec3(1.0), whole, balancing.step);
        sums.cached *= balance.correction;
    }
    balance.cached = sums.cached;
}
#endif
