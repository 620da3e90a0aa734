// SPDX-License-Identifier: MIT
// The packed numbers of face records (shared/voxels.h). C++ twin: src/voxels/voxel_record.h, bit for bit.
#include "lib/dot.glsl"
#include "lib/octahedral.glsl"
#include "lib/voxel_address.glsl"
#include "lib/voxel_levels.glsl"
#include "shared/voxels.h"

const float kVoxelWeightScale = 65535.0 / 4.0;  // W and area: [0,4] in 16 bits

// Number of the direction -> unit vector: +x -x +y -y +z -z.
vec3 directionVector(int direction) {
    float side = (direction & 1) == 0 ? 1.0 : -1.0;
    return vec3(direction < 2 ? side : 0.0, direction >= 2 && direction < 4 ? side : 0.0,
                direction >= 4 ? side : 0.0);
}

// Plane offset n.(c - centre)/h in [-1,1], coverage W in [0,4].
uint packOffsetWeight(float offset, float weight) {
    uint low = uint(int(floor(clamp(offset, -1.0, 1.0) * 32767.0 + 0.5))) & 0xffffu;
    return low | (uint(floor(clamp(weight, 0.0, 4.0) * kVoxelWeightScale + 0.5)) << 16);
}
float unpackOffset(uint bits) { return max(float(int(bits << 16) >> 16) / 32767.0, -1.0); }
float unpackWeight(uint bits) { return float(bits >> 16) / kVoxelWeightScale; }

// Opacity of the face seen along its direction.
float faceOpacity(uint offsetWeight) { return min(unpackWeight(offsetWeight), 1.0); }

// Corners in voxel units [0,1]; min is rounded down, max up, so that the box never shrinks.
uint packBounds(vec3 lower, vec3 upper) {
    uvec3 a = uvec3(floor(clamp(lower, 0.0, 1.0) * 31.0));
    uvec3 b = uvec3(ceil(clamp(upper, 0.0, 1.0) * 31.0));
    return a.x | (a.y << 5) | (a.z << 10) | (b.x << 15) | (b.y << 20) | (b.z << 25);
}
vec3 unpackBoundsMin(uint bits) { return vec3(uvec3(bits, bits >> 5, bits >> 10) & 31u) / 31.0; }
vec3 unpackBoundsMax(uint bits) { return vec3(uvec3(bits >> 15, bits >> 20, bits >> 25) & 31u) / 31.0; }

uint packAlbedo(vec3 albedo) {
    uvec3 q = uvec3(floor(clamp(albedo, 0.0, 1.0) * vec3(2047.0, 2047.0, 1023.0) + 0.5));
    return q.x | (q.y << 11) | (q.z << 22);
}
vec3 unpackAlbedo(uint bits) {
    return vec3(bits & 2047u, (bits >> 11) & 2047u, bits >> 22) / vec3(2047.0, 2047.0, 1023.0);
}

// Shared-exponent colour (OpenGL 4.5 core, 8.5.2): mantissas of 9 bits, 2^(exponent - 24).
uint packRgb9e5(vec3 color) {
    vec3 c = clamp(color, 0.0, 65408.0);
    float largest = max(max(c.r, c.g), c.b);
    // floor(log2) from the float's own exponent field, exact.
    int exponent = max(int(floatBitsToUint(largest) >> 23) - 127, -16) + 16;
    if (floor(largest * uintBitsToFloat(uint(151 - exponent) << 23) + 0.5) >= 512.0) ++exponent;
    uvec3 m = uvec3(floor(c * uintBitsToFloat(uint(151 - exponent) << 23) + 0.5));
    return m.x | (m.y << 9) | (m.z << 18) | (uint(exponent) << 27);
}
vec3 unpackRgb9e5(uint bits) {
    return vec3(bits & 511u, (bits >> 9) & 511u, (bits >> 18) & 511u) *
           uintBitsToFloat(((bits >> 27) + 103u) << 23);
}

// FaceMaterial. Area / h^2 in [0,4]: of the surface what is the face's own, (n.k)^2 of it, so that the faces
// of a voxel add up to it. `lobe`: packLobe.
uvec4 packFaceMaterial(vec3 albedo, vec3 emission, float area, uint lobe) {
    vec3 e = clamp(emission, 0.0, 65504.0);
    uint high = uint(floor(clamp(area, 0.0, 4.0) * kVoxelWeightScale + 0.5));
    return uvec4(packAlbedo(albedo), packHalf2x16(e.rg), packHalf2x16(vec2(e.b, 0.0)) | (high << 16), lobe);
}
vec3 unpackEmission(uvec4 material) { return vec3(unpackHalf2x16(material.y), unpackHalf2x16(material.z).x); }
float unpackArea(uvec4 material) { return float(material.z >> 16) / kVoxelWeightScale; }

// Metalness in 4 bits, roughness in 5: the lowest 9 bits.
uint packLobe(float metallic, float roughness) {
    return (uint(floor(clamp(metallic, 0.0, 1.0) * 15.0 + 0.5)) << 5) |
           uint(floor(clamp(roughness, 0.0, 1.0) * 31.0 + 0.5));
}
vec2 unpackLobe(uint bits) { return vec2((bits >> 5) & 15u, bits & 31u) / vec2(15.0, 31.0); }

// Plane of a face: unit normal, and its offset from the voxel's centre in voxels.
vec3 faceNormal(FaceRecord face) { return octDecode(unpackSnorm2x16(face.normal)); }
// The side of an axis that a normal looks to, as the number of a direction.
int sideOfAxis(int axis, vec3 n) {
    float along = axis == 0 ? n.x : (axis == 1 ? n.y : n.z);
    return 2 * axis + (along < 0.0 ? 1 : 0);
}
// The direction in which a normal leans most.
int mainDirection(vec3 n) {
    vec3 a = abs(n);
    return sideOfAxis(a.x >= a.y && a.x >= a.z ? 0 : (a.y >= a.z ? 1 : 2), n);
}
// The direction that a face with the normal n looks to.
int faceDirection(uvec4 hitTexel, vec3 n) { return sideOfAxis(int(hitTexel.w >> 30), n); }
// Offset from the plane of a face to just before the highest surface in front of it, along the face's axis: how far the
// bounds reach beyond a plane piece. Direct light on the face is evaluated there, not inside the surface in
// front. Zero for plane pieces, unless the rounding of the bounds exceeds its mean. A step that rounding cannot explain is
// real: then the offset, rounded too, leads before it, as light from straight above would be in its shadow.
const float kMeanRounding = 1.5 / 31.0;
const float kMostRounding = 3.0 / 31.0;
const float kBeforeFront = 0.5 / 31.0;
vec3 faceFrontOffset(uvec4 hitTexel, vec3 n) {
    uint axis = hitTexel.w >> 30;
    vec3 k = vec3(axis == 0u, axis == 1u, axis == 2u);
    k = dot(n, k) < 0.0 ? -k : k;
    float facing = max(dot(n, k), VOXEL_FACING_THRESHOLD);
    vec3 lower = unpackBoundsMin(hitTexel.z) - 0.5;
    vec3 upper = unpackBoundsMax(hitTexel.z) - 0.5;
    vec3 across = 1.0 - abs(k);
    float height = (unpackOffset(hitTexel.y) - dot(n, 0.5 * (lower + upper) * across)) / facing;
    float reach = 0.5 * dot(abs(n) * across, upper - lower) / facing;
    float top = max(dot(lower, k), dot(upper, k));
    float front = top - height - reach;
    return k * clamp(front + (front > kMostRounding ? kBeforeFront : -kMeanRounding), 0.0, 1.0);
}
// Centre of what the face holds: the middle of its bounds moved onto its plane, and up to what stands before
// it, in grid coordinates.
vec3 faceCenter(FaceRecord face) {
    vec3 n = faceNormal(face);
    vec3 middle = 0.5 * (unpackBoundsMin(face.bounds) + unpackBoundsMax(face.bounds)) - 0.5;
    vec3 frontOffset = faceFrontOffset(uvec4(face.normal, face.offsetWeight, face.bounds, face.voxel), n);
#if NESTED_GRIDS
    vec4 place = voxelPlace(face.voxel);
    return place.xyz +
           place.w * (0.5 + middle + n * (unpackOffset(face.offsetWeight) - dot(n, middle)) + frontOffset);
#else
    return vec3(unpackVoxel(face.voxel)) + 0.5 + middle +
           n * (unpackOffset(face.offsetWeight) - dot(n, middle)) + frontOffset;
#endif
}

// Bounds that reach the voxel's side are grown, voxels: by the first along the normal, by the second, which
// is how far pieces of one surface overlap, along it. Second: more makes balls too wide, less opens gaps
// between their pieces (docs/theory/4b_rays.md, "Bounds as rays see them").
const float kRayBoundsSlack = 0.1;
const float kRayBoundsOverlap = 0.04;
// Where they end within the voxel, they are shrunk by this along the surface, about as much as they are
// rounded outwards (up to 1/31), or all that is small would be too large. So are all for crossings before
// kRayNear: there lies the other wall of a corner, whose bounds hold the ray's start, or the other side of
// an edge, whose bounds end below it.
const float kRayBoundsShrink = 0.02;
// Bounds within which rays meet a face, in voxel units: all crossings beyond kRayNear, and no others.
void rayBounds(uint bounds, vec3 n, out vec3 lower, out vec3 upper) {
    vec3 shrunk = (kRayBoundsSlack + kRayBoundsShrink) * n * n - kRayBoundsShrink;
    vec3 grown = (kRayBoundsSlack - kRayBoundsOverlap) * n * n + kRayBoundsOverlap;
    lower = unpackBoundsMin(bounds);
    upper = unpackBoundsMax(bounds);
    lower -= mix(grown, shrunk, greaterThan(lower, vec3(0.0)));
    upper += mix(grown, shrunk, lessThan(upper, vec3(1.0)));
}

// Bounds within which light-sampled rays from `origin` (grid coordinates) choose their points: those of
// rayBounds. Where a plane along the grid goes on in the voxels on both sides, the bounds of neighbours
// overlap, and rays hit the nearer one. There the bounds are moved away from the origin instead of grown, so
// that each point is sampled once. `side`: 1; with -1 they are moved towards the origin, for planes that end
// at the voxel's side and only seem to go on (kMovedBoundsPeriod).
void lightSampleBounds(uvec4 hitTexel, vec3 n, vec3 origin, float side, out vec3 lower, out vec3 upper) {
    rayBounds(hitTexel.z, n, lower, upper);
    vec3 a = abs(n);
    bool alongGrid = max(a.x, max(a.y, a.z)) > 0.9999;
#if NESTED_GRIDS
    vec4 place = voxelPlace(hitTexel.w);
    vec3 from = place.xyz + 0.5 * place.w - origin;
#else
    vec3 from = vec3(unpackVoxel(hitTexel.w)) + 0.5 - origin;
#endif
    vec3 moved = side * kRayBoundsOverlap * sign(from);
    bvec3 goesOn =
        bvec3(alongGrid && lower.x < 0.0 && upper.x > 1.0, alongGrid && lower.y < 0.0 && upper.y > 1.0,
              alongGrid && lower.z < 0.0 && upper.z > 1.0);
    lower = mix(lower, moved, goesOn);
    upper = mix(upper, 1.0 + moved, goesOn);
}

// Share of the light samples of a voxel that a face gets (docs/theory/4c_estimator.md, (4.11)). Up to three
// faces hold the same surface, and rays hit the one of largest coverage: 1 for the face of the normal's
// largest component, little for the others.
float dominantFaceShare(vec3 n, uint axis) {
    vec3 a = abs(n);
    float part = (axis == 0u ? a.x : (axis == 1u ? a.y : a.z)) / max(a.x, max(a.y, a.z));
    return part * part * part * part;
}

// How much of the pool a face gets (docs/theory/4c_estimator.md, (4.11)).
float faceFlux(uvec4 hitTexel, vec3 radiance) {
    vec3 n = octDecode(unpackSnorm2x16(hitTexel.x));
    vec3 lower, upper;
    lightSampleBounds(hitTexel, n, vec3(0.0), 1.0, lower, upper);
    vec3 size = max(upper - lower, vec3(0.0));
    uint axis = hitTexel.w >> 30;
    float seen = axis == 0u ? size.y * size.z : (axis == 1u ? size.z * size.x : size.x * size.y);
    float facing = axis == 0u ? n.x : (axis == 1u ? n.y : n.z);
    return dot(radiance, vec3(1.0 / 3.0)) * seen * dominantFaceShare(n, axis) / max(abs(facing), 1e-3);
}
