// SPDX-License-Identifier: MIT
// One invocation per face: walks the chain of its voxel, sums up the fragments that face its direction
// (docs/theory/2_voxels.md, eq. 2.1), writes FaceRecord and faceSource.
//
// Sums are 64-bit integers in units of 2^-30: exact to 1e-9 of a full voxel side, without overflow for 2^33
// fragments, and the same whatever the order of the chain.
#version 450
layout(local_size_x = 64) in;
#include "voxels/surface_common.glsl"
#include "lib/voxel_record.glsl"
layout(std430, binding = SURFACE_COUNTERS) readonly buffer CounterTable { uint counters[]; };
layout(std430, binding = BINDING_VOXEL_FACES) writeonly buffer FaceTable { uvec4 faces[]; };
layout(std430, binding = SURFACE_FACE_SOURCES) writeonly buffer SourceTable { uvec2 faceSources[]; };
layout(binding = SURFACE_UNIT_PAIRS) uniform usamplerBuffer pairs;
layout(binding = SURFACE_UNIT_FRAGMENTS) uniform usamplerBuffer fragments;
layout(binding = SURFACE_UNIT_OWNERS) uniform usamplerBuffer owners;
layout(binding = SURFACE_UNIT_CHAINS) uniform usamplerBuffer chains;

const float kUnit = 1073741824.0;  // 2^30

// Adds a value of magnitude below 2 to 64-bit sums in two's complement.
void addTo(inout uvec3 low, inout uvec3 high, vec3 value) {
    ivec3 v = ivec3(floor(value * kUnit + 0.5));
    uvec3 sum = low + uvec3(v);
    high += uvec3(v >> 31) + uvec3(lessThan(sum, low));
    low = sum;
}
vec3 valueOf(uvec3 low, uvec3 high) {
    // Magnitude first: converting the halves of a small negative number would lose it.
    bvec3 negative = greaterThanEqual(high, uvec3(0x80000000u));
    uvec3 l = mix(low, ~low + 1u, negative);
    uvec3 h = mix(high, ~high + uvec3(equal(low, uvec3(0u))), negative);
    vec3 magnitude = (vec3(h) * 4294967296.0 + vec3(l)) / kUnit;
    return mix(magnitude, -magnitude, negative);
}

void main() {
    uint index = linearInvocation();
    uint count = min(counters[SURFACE_FACES], surface.faceCapacity);
    bool used = index < count;
    uint owner = texelFetch(owners, int(used ? index : 0u)).x;
    int direction = int(owner >> 28);
    int record = int(owner & 0xfffffffu);
    uint head = texelFetch(chains, 2 * record).x;
    uint voxel = texelFetch(pairs, int(head) - 1).y;

    uvec3 normalLow = uvec3(0u), normalHigh = uvec3(0u);
    uvec3 centerLow = uvec3(0u), centerHigh = uvec3(0u);
    uvec3 albedoLow = uvec3(0u), albedoHigh = uvec3(0u);
    uvec3 emissionLow = uvec3(0u), emissionHigh = uvec3(0u);
    uvec3 otherLow = uvec3(0u), otherHigh = uvec3(0u);  // weight, area, 0
    uvec3 lower = uvec3(31u);
    uvec3 upper = uvec3(0u);
    float emissionUnit = 1.0 / surface.emissionScale;
    uint at = used ? head : 0u;
    vec3 k = directionVector(direction);
    do {
        int i = 2 * max(int(at) - 1, 0);
        uvec4 a = texelFetch(fragments, i);
        uvec4 b = texelFetch(fragments, i + 1);
        vec3 n = octDecode(unpackSnorm2x16(a.w));
        float facing = dot(n, k);
        bool counts = ((b.y >> (24 + direction)) & 1u) != 0u && at != 0u;
        // A direction that the front does not face is faced by the back of a two-sided triangle.
        n = facing < 0.0 ? -n : n;
        facing = abs(facing);
        float area = counts ? uintBitsToFloat(a.y) : 0.0;
        float w = area * facing * float((b.y >> 16) & 255u) / 255.0;
        vec3 center = vec3(b.x & 0xffffu, b.x >> 16, b.y & 0xffffu) / 65535.0 - 0.5;
        addTo(normalLow, normalHigh, w * n);
        addTo(centerLow, centerHigh, w * center);
        addTo(albedoLow, albedoHigh, w * unpackAlbedo(b.z));
        addTo(emissionLow, emissionHigh, min(w * unpackRgb9e5(b.w) * emissionUnit, 1.9));
        addTo(otherLow, otherHigh, vec3(w, area, 0.0));
        uvec3 boxMin = uvec3(a.z, a.z >> 5, a.z >> 10) & 31u;
        uvec3 boxMax = uvec3(a.z >> 15, a.z >> 20, a.z >> 25) & 31u;
        lower = counts ? min(lower, boxMin) : lower;
        upper = counts ? max(upper, boxMax) : upper;
        at = at != 0u ? a.x : 0u;
    } while (at != 0u);

    // Normalised; the clip pass keeps only what leaves a weight.
    vec3 other = valueOf(otherLow, otherHigh);
    float weight = max(other.x, 1.0 / kUnit);
    vec3 sum = valueOf(normalLow, normalHigh);
    vec3 n = dot(sum, sum) > 0.0 ? normalize(sum) : k;
    float offset = dot(n, valueOf(centerLow, centerHigh)) / weight;
    vec3 albedo = valueOf(albedoLow, albedoHigh) / weight;
    vec3 emission = valueOf(emissionLow, emissionHigh) / weight * surface.emissionScale;
    uint bounds = lower.x | (lower.y << 5) | (lower.z << 10) | (upper.x << 15) | (upper.y << 20) | (upper.z << 25);
    if (used) {
        faces[2u * index] = uvec4(packSnorm2x16(octEncode(n)), packOffsetWeight(offset, weight), bounds, voxel);
        faces[2u * index + 1u] = uvec4(packAlbedo(albedo), packRgb9e5(emission), 0u, 0u);
        faceSources[index] = packFaceSource(emission, other.y);
    }
}
