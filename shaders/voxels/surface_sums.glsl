// SPDX-License-Identifier: MIT
// From fragments to a face record (docs/theory/2_voxels.md, eq. 2.2): what surface_resolve and surface_layers
// share. Sums are integers in units of 2^-26 voxel sides or coarser, so the order of fragments does not
// matter. All terms are weights times numbers in [0,1], so no sum exceeds that of the weights.
// SURFACE_EMISSION 0: no material emits, nothing is summed.
// SURFACE_LOBES 0: no material is metallic; fragments have no lobe in the lowest bits of their area.
#ifndef SURFACE_LOBES
#error SURFACE_LOBES must be 0 or 1
#endif
layout(std430, binding = SURFACE_FACE_SOURCES) writeonly buffer SourceTable { uvec2 faceSources[]; };
layout(binding = SURFACE_UNIT_FRAGMENTS) uniform usamplerBuffer fragments;
layout(binding = SURFACE_UNIT_OWNERS) uniform usamplerBuffer owners;
#if SURFACE_EMISSION
layout(binding = SURFACE_UNIT_PAIRS) uniform usamplerBuffer pairs;
#endif

// A fragment as a face sees it.
struct Fragment {
    uint next;      // place of the next one + 1, 0: last
    float area;     // x coverage, in voxel sides; 0 when it does not face the direction
    float facing;   // n.k
    vec3 normal;    // of two-sided triangles that of the side that faces the direction
    ivec3 center;   // in 1/65535 voxel
    uint bounds;    // lib/voxel_record.glsl; bits 30, 31 are of no meaning
    uint albedo;    // packed
    uint emission;  // packed; the voxel when SURFACE_EMISSION is 0
    vec2 lobe;      // metalness, roughness
    bool twoSided;
    bool turned;  // the other side of a two-sided triangle
};

// `at`: place + 1; 0: none, which counts nothing.
Fragment readFragment(uint at, vec3 k) {
    int i = 2 * max(int(at) - 1, 0);
    uvec4 a = texelFetch(fragments, i);
    uvec4 b = texelFetch(fragments, i + 1);
    vec3 n = vec3(unpackSnorm16(a.w), unpackSnorm16(a.w >> 16), unpackSnorm16(b.x));
    float facing = dot(n, k);
    bool turned = facing < 0.0 && (a.z & 0x40000000u) != 0u;
    n = turned ? -n : n;
    facing = turned ? -facing : facing;
    bool counts = facing > VOXEL_FACING_THRESHOLD && at != 0u && a.y != 0u;
#if SURFACE_LOBES
    uint areaBits = a.y & ~0x1ffu;
    vec2 lobe = unpackLobe(a.y);
#else
    uint areaBits = a.y;
    vec2 lobe = vec2(0.0);
#endif
    return Fragment(at != 0u ? a.x : 0u, counts ? uintBitsToFloat(areaBits) : 0.0, facing, n,
                    ivec3(b.x >> 16, b.y & 0xffffu, b.y >> 16), a.z, b.z, b.w, lobe,
                    (a.z & 0x40000000u) != 0u, turned);
}

struct FaceSums {
    int weightLow;  // 64 bits
    uint weightHigh;
    int area;  // in two units
    ivec3 normal, center, albedo, emission;
    ivec3 lower, upper;  // bounds, in 1/31 voxel
    ivec2 lobe;          // metalness; metalness x roughness
    int twoSided;        // weights of two-sided triangles, and of those seen from their other side
    int turned;
};

FaceSums emptySums() {
    return FaceSums(0, 0u, 0, ivec3(0), ivec3(0), ivec3(0), ivec3(0), ivec3(31), ivec3(0), ivec2(0), 0, 0);
}

float unitsOf(int shift) { return uintBitsToFloat(uint(127 + shift) << 23); }  // 2^shift
float inverseUnits(int shift) { return uintBitsToFloat(uint(127 - shift) << 23); }

// Adds `covered` units of the fragment's area. Rounded by truncation of positive numbers.
void addFragment(inout FaceSums sums, Fragment f, float covered, bool bounded) {
    float w = covered * f.facing;
    int rounded = int(w + 0.5);
    uint sum = uint(sums.weightLow) + uint(rounded);
    sums.weightHigh += sum < uint(sums.weightLow) ? 1u : 0u;
    sums.weightLow = int(sum);
    sums.twoSided += f.twoSided ? rounded : 0;
    sums.turned += f.turned ? rounded : 0;
    sums.area += int(covered * 0.5 + 0.5);
    sums.normal += ivec3(w * (0.5 * f.normal + 0.5) + 0.5);
    sums.center += ivec3((w * (1.0 / 65535.0)) * vec3(f.center) + 0.5);
    sums.albedo += ivec3(w * (vec3(ivec3(f.albedo & 2047u, (f.albedo >> 11) & 2047u, f.albedo >> 22)) *
                              vec3(1.0 / 2047.0, 1.0 / 2047.0, 1.0 / 1023.0)) +
                         0.5);
#if SURFACE_EMISSION
    sums.emission += ivec3(w * min(unpackRgb9e5(f.emission) * (1.0 / surface.emissionScale), 1.0) + 0.5);
#endif
#if SURFACE_LOBES
    sums.lobe += ivec2(w * f.lobe.x * vec2(1.0, f.lobe.y) + 0.5);
#endif
    const uint kNeutralBounds = 0x7fffu;  // min 31, max 0
    uint bounds = bounded ? f.bounds : kNeutralBounds;
    sums.lower = min(sums.lower, ivec3(uvec3(bounds, bounds >> 5, bounds >> 10) & 31u));
    sums.upper = max(sums.upper, ivec3(uvec3(bounds >> 15, bounds >> 20, bounds >> 25) & 31u));
}

// Area of the bounds seen along an axis, in voxel sides.
float boundsArea(ivec3 lower, ivec3 upper, int axis) {
    vec3 size = vec3(max(upper - lower, 0)) * (1.0 / 31.0);
    return axis == 0 ? size.y * size.z : (axis == 1 ? size.z * size.x : size.x * size.y);
}

struct ResolvedFace {
    uvec4 hit;  // the two texels of FaceRecord
    uvec4 shade;
    uvec2 source;
};

ResolvedFace resolvedFace(FaceSums sums, int shift, int direction, uint voxel) {
    // The clip pass keeps only what leaves a weight; one unit stands in for less.
    float unit = inverseUnits(shift);
    float total = float(max(sums.weightLow, 1));
    vec3 k = directionVector(direction);
    vec3 n = vec3(sums.normal) * (2.0 / total) - 1.0;
    n = dot(n, k) > 0.0 ? normalize(n) : k;
    float offset = dot(n, vec3(sums.center) / total - 0.5);
    vec3 glow = vec3(0.0);
#if SURFACE_EMISSION
    glow = vec3(sums.emission) / total * surface.emissionScale;
#endif
    uint lobe = 0u;
#if SURFACE_LOBES
    // Roughness is that of the metals in the voxel.
    lobe = packLobe(float(sums.lobe.x) / total, float(sums.lobe.y) / float(max(sums.lobe.x, 1)));
#endif
    ivec3 a = sums.lower;
    ivec3 b = sums.upper;
    uint bounds = uint(a.x | (a.y << 5) | (a.z << 10) | (b.x << 15) | (b.y << 20) | (b.z << 25));
    bounds |= sums.twoSided > sums.weightLow / 2 ? FACE_TWO_SIDED : 0u;
    bounds |= sums.turned > sums.weightLow / 2 ? FACE_REVERSE : 0u;
    return ResolvedFace(uvec4(packSnorm2x16(octEncode(n)), packOffsetWeight(offset, total * unit), bounds,
                              voxel | (uint(direction >> 1) << 30)),
                        uvec4(packAlbedo(vec3(sums.albedo) / total), packRgb9e5(glow), 0u, lobe << 16),
                        packFaceSource(glow, float(sums.area) * 2.0 * unit));
}
