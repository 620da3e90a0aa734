// SPDX-License-Identifier: MIT
// One invocation per face: walks the chain of its voxel, sums up the fragments that face its direction
// (docs/theory/2_voxels.md, eq. 2.2), writes FaceRecord and faceSource.
//
// Sums are integers in units of 2^-26 voxel sides, so the order of the chain does not matter. All terms are
// weights times numbers in [0,1], so no sum exceeds that of the weights, which is kept in 64 bits: should it
// reach 16 (never in a sane scene), the chain is walked again with units coarse enough that nothing
// overflows.
//
// SURFACE_EMISSION 0: no material emits, nothing is summed.
//
// Tried on a software driver (cost of this pass): fragments through storage reads instead of a buffer texture
// +17 %; fetching the next fragment while this one is added, no gain; all sums in 64 bits +50 %; looking up
// chain and voxel through the voxel's record instead of the owner list +15 %.
#version 450
#ifndef SURFACE_UPDATE
#error SURFACE_UPDATE must be 0 or 1
#endif
#ifndef SURFACE_EMISSION
#error SURFACE_EMISSION must be 0 or 1
#endif
layout(local_size_x = 64) in;
#include "lib/voxel_record.glsl"
#include "voxels/surface_common.glsl"
layout(std430, binding = SURFACE_COUNTERS) readonly buffer CounterTable { uint counters[]; };
layout(std430, binding = BINDING_VOXEL_FACES) writeonly buffer FaceTable { uvec4 faces[]; };
layout(std430, binding = SURFACE_FACE_SOURCES) writeonly buffer SourceTable { uvec2 faceSources[]; };
#if SURFACE_EMISSION
layout(binding = SURFACE_UNIT_PAIRS) uniform usamplerBuffer pairs;
#endif
#if SURFACE_UPDATE
layout(std430, binding = SURFACE_WORK_LIST) readonly buffer WorkTable { uint work[]; };
#endif
layout(binding = SURFACE_UNIT_FRAGMENTS) uniform usamplerBuffer fragments;
layout(binding = SURFACE_UNIT_OWNERS) uniform usamplerBuffer owners;

const uint kNeutralBounds = 0x7fffu;  // min 31, max 0

void main() {
    uint index = linearInvocation();
#if SURFACE_UPDATE
    bool used = index < min(counters[SURFACE_WORK], surface.faceCapacity);
    index = work[used ? index : 0u];
#else
    bool used = index < min(counters[SURFACE_FACES], surface.faceCapacity);
#endif
    uint owner = texelFetch(owners, int(used ? index : 0u)).x;
    int direction = int(owner >> 29);
    uint head = owner & 0x1fffffffu;
    vec3 k = directionVector(direction);

    int weightLow;
    uint weightHigh;
    int area;
    ivec3 normal, center, albedo, emission;
    ivec3 lower, upper;
    int shift = 26;
    bool again;
    uint voxel = 0u;
    do {
        float unit = uintBitsToFloat(uint(127 + shift) << 23);
        weightLow = 0;
        weightHigh = 0u;
        area = 0;
        normal = ivec3(0);
        center = ivec3(0);
        albedo = ivec3(0);
        emission = ivec3(0);
        lower = ivec3(31);
        upper = ivec3(0);
        uint at = used ? head : 0u;
        do {
            int i = 2 * max(int(at) - 1, 0);
            uvec4 a = texelFetch(fragments, i);
            uvec4 b = texelFetch(fragments, i + 1);
            vec3 n = vec3(unpackSnorm16(a.w), unpackSnorm16(a.w >> 16), unpackSnorm16(b.x));
            // A two-sided triangle turns towards the direction.
            float facing = dot(n, k);
            bool turned = facing < 0.0 && (a.z & 0x40000000u) != 0u;
            n = turned ? -n : n;
            facing = turned ? -facing : facing;
            bool counts = facing > VOXEL_FACING_THRESHOLD && at != 0u && a.y != 0u;
            float covered = counts ? uintBitsToFloat(a.y) * unit : 0.0;
            float w = covered * facing;
            // Rounded by truncation of positive numbers.
            int rounded = int(w + 0.5);
            uint sum = uint(weightLow) + uint(rounded);
            weightHigh += sum < uint(weightLow) ? 1u : 0u;
            weightLow = int(sum);
            area += int(covered * 0.5 + 0.5);
            normal += ivec3(w * (0.5 * n + 0.5) + 0.5);
            center += ivec3((w * (1.0 / 65535.0)) * vec3(ivec3(b.x >> 16, b.y & 0xffffu, b.y >> 16)) + 0.5);
            albedo += ivec3(w * (vec3(ivec3(b.z & 2047u, (b.z >> 11) & 2047u, b.z >> 22)) *
                                 vec3(1.0 / 2047.0, 1.0 / 2047.0, 1.0 / 1023.0)) +
                            0.5);
#if !SURFACE_EMISSION
            voxel = at != 0u ? b.w : voxel;
#else
            emission += ivec3(w * min(unpackRgb9e5(b.w) * (1.0 / surface.emissionScale), 1.0) + 0.5);
#endif
            uint bounds = counts ? a.z : kNeutralBounds;
            lower = min(lower, ivec3(uvec3(bounds, bounds >> 5, bounds >> 10) & 31u));
            upper = max(upper, ivec3(uvec3(bounds >> 15, bounds >> 20, bounds >> 25) & 31u));
            at = at != 0u ? a.x : 0u;
        } while (at != 0u);
        // Next time the sum is below 2^30.
        again = weightHigh != 0u || weightLow < 0 || weightLow >= 1 << 30;
        shift -= again ? (weightHigh != 0u ? findMSB(weightHigh) + 3 : 2) : 0;
    } while (again);

    // The clip pass keeps only what leaves a weight; one unit stands in for less.
    float unit = uintBitsToFloat(uint(127 - shift) << 23);
    float total = float(max(weightLow, 1));
    vec3 n = vec3(normal) * (2.0 / total) - 1.0;
    n = dot(n, k) > 0.0 ? normalize(n) : k;
    float offset = dot(n, vec3(center) / total - 0.5);
    vec3 glow = vec3(0.0);
#if SURFACE_EMISSION
    voxel = texelFetch(pairs, int(head) - 1).y;
    glow = vec3(emission) / total * surface.emissionScale;
#endif
    uint bounds = uint(lower.x | (lower.y << 5) | (lower.z << 10) | (upper.x << 15) | (upper.y << 20) |
                       (upper.z << 25));
    if (used) {
        faces[2u * index] = uvec4(packSnorm2x16(octEncode(n)), packOffsetWeight(offset, total * unit), bounds,
                                  voxel | (uint(direction >> 1) << 30));
        faces[2u * index + 1u] = uvec4(packAlbedo(vec3(albedo) / total), packRgb9e5(glow), 0u, 0u);
        faceSources[index] = packFaceSource(glow, float(area) * 2.0 * unit);
    }
}
