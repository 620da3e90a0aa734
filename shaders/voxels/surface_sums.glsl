// SPDX-License-Identifier: MIT
// From fragments to a face record (docs/theory/2_voxels.md, eq. 2.2): what surface_resolve and surface_layers
// share. Sums are integers in units of 2^-26 voxel sides or coarser, so the order of fragments does not
// matter. All terms are weights times numbers in [0,1], so no sum exceeds that of the weights.
// SURFACE_EMISSION 0: no material emits, nothing is summed.
// SURFACE_LOBES 0: no material has a lobe that rays tell from diffuse light; fragments have none in the lowest
// bits of their area.
#ifndef SURFACE_LOBES
#error SURFACE_LOBES must be 0 or 1
#endif
#include "lib/clip.glsl"
#include "lib/dot.glsl"
#include "lib/plane_piece.glsl"
layout(std430) writeonly buffer FaceMaterialTable { uvec4 faceMaterials[]; };
uniform usamplerBuffer fragments;
uniform usamplerBuffer owners;
#if SURFACE_EMISSION
uniform usamplerBuffer pairs;
#endif

// A fragment as a face sees it.
struct Fragment {
    uint next;      // place of the next one + 1, 0: last
    float area;     // x coverage, in voxel sides; 0 when it does not face the direction
    float whole;    // the same, whichever way it faces
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
    bool turned = facing < 0.0 && (a.z & FRAGMENT_TWO_SIDED) != 0u;
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
    float whole = at != 0u ? uintBitsToFloat(areaBits) : 0.0;
    return Fragment(at != 0u ? a.x : 0u, counts ? whole : 0.0, whole, facing, n,
                    ivec3(b.x >> 16, b.y & 0xffffu, b.y >> 16), a.z, b.z, b.w, lobe,
                    (a.z & FRAGMENT_TWO_SIDED) != 0u, turned);
}

struct FaceSums {
    int weightLow;  // 64 bits
    uint weightHigh;
    int area;  // what is this face's own: the faces of a voxel add up to the surface's
    ivec3 normal, center, albedo, emission;
    ivec3 lower, upper;  // bounds, in 1/31 voxel
    ivec3 lobe;          // metalness; metalness x roughness; roughness
    int twoSided;        // weights of two-sided triangles, and of those seen from their other side
    int turned;
};

FaceSums emptySums() {
    return FaceSums(0, 0u, 0, ivec3(0), ivec3(0), ivec3(0), ivec3(0), ivec3(31), ivec3(0), ivec3(0), 0, 0);
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
    sums.area += int(w * f.facing + 0.5);
    sums.normal += ivec3(w * (0.5 * f.normal + 0.5) + 0.5);
    sums.center += ivec3((w * (1.0 / 65535.0)) * vec3(f.center) + 0.5);
    sums.albedo += ivec3(w * (vec3(ivec3(f.albedo & 2047u, (f.albedo >> 11) & 2047u, f.albedo >> 22)) *
                              vec3(1.0 / 2047.0, 1.0 / 2047.0, 1.0 / 1023.0)) +
                         0.5);
#if SURFACE_EMISSION
    sums.emission += ivec3(w * min(unpackRgb9e5(f.emission) * (1.0 / surface.emissionScale), 1.0) + 0.5);
#endif
#if SURFACE_LOBES
    sums.lobe += ivec3(w * vec3(f.lobe.x, f.lobe.x * f.lobe.y, f.lobe.y) + 0.5);
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
    uvec4 hit;       // FaceRecord
    uvec4 material;  // FaceMaterial
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
    // Roughness is that of the metals in the voxel, if there are any.
    float metallic = float(sums.lobe.x) / total;
    bool metal = packLobe(metallic, 0.0) != 0u;
    lobe = packLobe(metallic, metal ? float(sums.lobe.y) / float(sums.lobe.x) : float(sums.lobe.z) / total);
#endif
    ivec3 a = sums.lower;
    ivec3 b = sums.upper;
    uint bounds = uint(a.x | (a.y << 5) | (a.z << 10) | (b.x << 15) | (b.y << 20) | (b.z << 25));
    bounds |= sums.twoSided > sums.weightLow / 2 ? FACE_TWO_SIDED : 0u;
    bounds |= sums.turned > sums.weightLow / 2 ? FACE_REVERSE : 0u;
    return ResolvedFace(uvec4(packSnorm2x16(octEncode(n)), packOffsetWeight(offset, total * unit), bounds,
                              voxel | (uint(direction >> 1) << 30)),
                        packFaceMaterial(vec3(sums.albedo) / total, glow, float(sums.area) * unit, lobe));
}

// --- Bounds that fit (docs/theory/2_voxels.md, eq. 2.8)

const float kBoundsStep = 1.0 / 31.0;
const float kFitted = 0.98;      // share of the bounds from which on a piece fills them
const float kSameWay = 0.5;      // cosine of normals of one surface
const float kFrontShare = 0.25;  // in front of a piece, of what is behind: in a corner
const float kMostHidden = 1.0;   // of a wall's area, what it hides at most
const float kClosed = 0.2;       // of closed solids areas as vectors cancel: what is left, of all area
const float kFrontUnits = 65536.0;

// Sides of a box that end within the voxel moved inwards.
void shrinkEnds(float by, inout vec3 lower, inout vec3 upper) {
    lower.xy += mix(vec2(0.0), vec2(by), greaterThan(lower.xy, vec2(-0.49)));
    upper.xy -= mix(vec2(0.0), vec2(by), lessThan(upper.xy, vec2(0.49)));
}

// What a face says of its plane, in coordinates whose third axis is the one that the plane is most turned to.
struct FacePlane {
    vec3 normal, center, lower, upper;  // of what the face holds, from the voxel's centre
    float offset;
    float held;      // area of what the face holds, seen along that axis
    float flatness;  // length of the mean of its unit normals
    int axis;
};

FacePlane facePlane(FaceSums sums, int shift, vec3 k, uvec4 hit) {
    vec3 n = octDecode(unpackSnorm2x16(hit.x));
    int axis = dominantAxis(n);
    vec3 m = toDominant(n, axis);
    return FacePlane(m, toDominant(vec3(sums.center) / float(max(sums.weightLow, 1)) - 0.5, axis),
                     toDominant(vec3(sums.lower) * kBoundsStep - 0.5, axis),
                     toDominant(vec3(sums.upper) * kBoundsStep - 0.5, axis), unpackOffset(hit.y),
                     float(sums.weightLow) * inverseUnits(shift) * abs(m.z) / max(dot(n, k), 1e-3),
                     length(vec3(sums.normal) * (2.0 / float(max(sums.weightLow, 1))) - 1.0), axis);
}

// Whether the bounds hold more of the plane than rounding explains.
bool boundsTooWide(FacePlane plane) {
    vec3 a = plane.lower;
    vec3 b = plane.upper;
    shrinkEnds(kBoundsStep, a, b);
    return plane.held * plane.flatness < kFitted * pieceArea(plane.normal, plane.offset, a, b);
}

// What else the voxel of a face holds.
struct ChainSums {
    int front, behind;  // moments about the face's plane of what is turned away from it
    int hiding;         // area of what of that is in front
    float seen;         // part of what the face holds that is not the inside of a closed solid
    bool closed;
};

// `at`: head of the voxel's chain; n, center: of the face's plane. Sums are of integers, as the chain has no order.
ChainSums besideFace(uint at, vec3 k, vec3 n, vec3 center) {
    ChainSums beside = ChainSums(0, 0, 0, 1.0, false);
    int all = 0, inside = 0, outside = 0;
    ivec3 outwards = ivec3(0);
    do {
        Fragment f = readFragment(at, k);
        float height = dot(n, vec3(f.center) * (1.0 / 65535.0) - 0.5 - center);
        bool other = abs(dot(n, f.normal)) < kSameWay;
        int area = int(min(f.whole, 1024.0) * kFrontUnits + 0.5);
        int moment = int(min(f.whole * abs(height), 1024.0) * kFrontUnits + 0.5);
        beside.front += other && height > 0.0 ? moment : 0;
        beside.behind += other && height < 0.0 ? moment : 0;
        beside.hiding += other && height > 0.0 ? area : 0;
        int held = int(min(f.area * f.facing, 1024.0) * kFrontUnits + 0.5);
        inside += f.turned ? held : 0;
        outside += f.turned ? 0 : held;
        outwards += ivec3(floor(float(area) * (f.turned ? -f.normal : f.normal) + 0.5));
        all += area;
        at = f.next;
    } while (at != 0u);
    beside.closed = length(vec3(outwards)) < kClosed * float(all);
    beside.seen = beside.closed ? float(max(inside, outside)) / float(max(inside + outside, 1)) : 1.0;
    return beside;
}

// Where the surface ends within the voxel askew, its bounds hold more of its plane than there is of it, and
// rays find it too wide: the bounds are shrunk about its centroid. Not in corners, where the rest is behind
// the other wall and a smaller piece would leave a hole. That wall hides no more than its own area: the sides of
// a thin rod make no corner. `at`: head of the voxel's chain, 0: leave it as it is.
void fitBounds(FaceSums sums, FacePlane plane, vec3 k, uint at, inout ResolvedFace face) {
    int axis = plane.axis;
    vec3 m = plane.normal;
    vec3 c = plane.center;
    vec3 low = plane.lower;
    vec3 high = plane.upper;
    float offset = plane.offset;
    ChainSums beside = besideFace(at, k, fromDominant(m, axis), fromDominant(c, axis));
    float held = plane.held * beside.seen * (beside.closed ? plane.flatness : 1.0);
    float tooMuch = pieceArea(m, offset, low, high) - held;
    bool corner = float(beside.front) > kFrontShare * float(beside.behind) &&
                  kMostHidden * float(beside.hiding) >= kFrontUnits * tooMuch;
    bool fits = at != 0u && !corner;
    vec3 a, b;

    // An axis along which the centroid is off the middle is one along which the surface ends.
    vec2 half2 = max(0.5 * (high.xy - low.xy), 0.5 * kBoundsStep);
    vec2 uneven = clamp(abs(c.xy - 0.5 * (low.xy + high.xy)) / half2, 0.0, 1.0) + 0.05;
    vec2 part = uneven / (uneven.x + uneven.y);
    vec2 slope = abs(m.xy / m.z);
    float middle = (offset - dot(m.xy, 0.5 * (low.xy + high.xy))) / m.z;
    float top = min(middle + dot(slope, half2), high.z);
    float bottom = max(middle - dot(slope, half2), low.z);
    float scale = 1.0;
    int i = 0;
    do {
        vec2 h = half2 * exp2(log2(scale) * part);
        vec2 at2 = clamp(c.xy, low.xy + h, high.xy - h);
        float height = (offset - dot(m.xy, at2)) / m.z;
        float reach = dot(slope, h);
        // What stands before the plane stays as far before it (faceFrontOffset).
        a = vec3(at2 - h, low.z + max(height - reach - bottom, 0.0));
        b = vec3(at2 + h, high.z - max(top - height - reach, 0.0));
        vec3 inner = a;
        vec3 outer = b;
        shrinkEnds(kRayBoundsShrink, inner, outer);
        scale = clamp(scale * held / max(pieceArea(m, offset, inner, outer), 1e-4), 1e-3, 1.0);
    } while (++i < 6 && fits);
    ivec3 lower = clamp(ivec3((fromDominant(a, axis) + 0.5) * 31.0 + 0.5), sums.lower, sums.upper);
    ivec3 upper =
        clamp(ivec3((fromDominant(b, axis) + 0.5) * 31.0 + 0.5), min(lower + 1, sums.upper), sums.upper);
    uint bounds = uint(lower.x | (lower.y << 5) | (lower.z << 10) | (upper.x << 15) | (upper.y << 20) |
                       (upper.z << 25));
    face.hit.z = fits ? bounds | (face.hit.z & (FACE_TWO_SIDED | FACE_REVERSE)) : face.hit.z;
}
