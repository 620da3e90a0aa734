#version 450 core
// SPDX-License-Identifier: MIT
// What part of its emission a face shows to rays, so that a lamp's voxels send what the lamp sends
// (docs/theory/4c_estimator.md, (4.36)). Where several plane pieces stand for a curved surface or for an
// edge, they reach beyond it, and to rays they are larger than the surface. Bricks in which all that shines
// lies in one plane are left as they are.
//
// STEP 0, per brick of the grid: marks the faces whose size is asked for. 1, per face: its size as rays meet
// it and the area of the surface that it stands for. 2, per brick: the quotient of the sums, the same for all
// its faces. Faces of one brick are next to each other.
#ifndef STEP
#error STEP must be 0, 1 or 2
#endif
layout(local_size_x = 64) in;
#include "lib/clip.glsl"
#include "lib/linear_index.glsl"
#include "lib/plane_piece.glsl"
#include "lib/random.glsl"
#include "lib/ray_query.glsl"
#include "lib/tangent_frame.glsl"
uniform usamplerBuffer voxelFaceMaterials;
// After step 0: 1 or 0; 1: both areas as halves; 2: the part, a float.
layout(std430) buffer EmissionFit { uint parts[]; };

const float kOnePlane = 0.98;    // cosine of normals up to which faces are of one plane
const int kRays = 16;            // per face; sums over a brick are within 3 %, over a lamp within 1 %
const float kFromOutside = 1.5;  // voxels: what reaches beyond the surface is nearer
const float kLeast = 0.5, kMost = 1.5;

vec3 normalOf(int face) { return octDecode(unpackSnorm2x16(texelFetch(voxelFaces, face).x)); }
bool emits(int face) { return unpackEmission(texelFetch(voxelFaceMaterials, face)) != vec3(0.0); }

#if STEP == 1
// Area of what is within the face's bounds, times the part of rays from outside towards it that find it
// first.
float seenArea(int face, bool asked) {
    uvec4 r = texelFetch(voxelFaces, face);
    vec3 n = octDecode(unpackSnorm2x16(r.x));
    vec3 lower, upper, u, v;
    rayBounds(r.z, n, lower, upper);
    tangentFrame(n, u, v);
    int axis = dominantAxis(n);
    vec3 m = toDominant(n, axis);
    lower = toDominant(lower, axis) - 0.5;
    upper = max(toDominant(upper, axis) - 0.5, lower);
    float offset = unpackOffset(r.y);
    uint seed = randomHash(r.w);
    float found = 0.0, tried = 0.0;
    int i = 0;
    do {
        vec2 place = sequencePoint(seed, uint(i));
        vec3 turn = sequencePoint3(seed, uint(i));
        vec3 point = vec3(mix(lower.xy, upper.xy, place), 0.0);
        point.z = (offset - dot(m.xy, point.xy)) / m.z;
        bool inside = asked && point.z >= lower.z && point.z <= upper.z;
        float across = sqrt(turn.x);
        float phi = 6.28318530718 * turn.y;
        vec3 leaves = across * cos(phi) * u + across * sin(phi) * v + sqrt(max(1.0 - turn.x, 0.0)) * n;
        vec3 from = vec3(unpackVoxel(r.w)) + 0.5 + fromDominant(point, axis) + kFromOutside * leaves;
        VoxelHit hit = traceVoxels(Ray(from, -leaves, inside ? kFromOutside + 0.5 : -1.0, vec3(0.0)));
        // What else stands before the lamp takes light of it, but does not make it smaller.
        bool counts = inside && hit.face >= 0 && emits(max(hit.face, 0));
        tried += counts ? 1.0 : 0.0;
        found += counts && hit.face == face ? 1.0 : 0.0;
    } while (++i < (asked ? kRays : 1));
    return pieceArea(m, offset, lower, upper) / abs(m.z) * (tried > 0.0 ? found / tried : 1.0);
}

void main() {
    int face = int(min(linearIndex(), grid.faceCount - 1u));
    bool used = linearIndex() < grid.faceCount;
    float area = unpackArea(texelFetch(voxelFaceMaterials, face));
    bool asked = used && parts[face] != 0u && emits(face);
    float seen = seenArea(face, asked);
    if (used) parts[face] = packHalf2x16(vec2(asked ? seen : area, area));
}
#else
void main() {
    uint brick = linearIndex();
    ivec3 bricks = gridBricks();
    bool used = brick < uint(bricks.x * bricks.y * bricks.z);
    uvec4 word = imageLoad(voxelBrickImage, brickOfIndex(used ? brick : 0u, bricks));
    int voxels = bitCount(word.x) + bitCount(word.y);
    if (!used || voxels == 0) return;
    uint lastRecord = texelFetch(voxelRecords, int(word.z) + voxels - 1).x;
    int first = int(faceBase(texelFetch(voxelRecords, int(word.z)).x));
    int end = int(faceBase(lastRecord)) + bitCount(faceDirections(lastRecord));
#if STEP == 0
    bool found = false, onePlane = true;
    vec3 n = vec3(0.0);  // of the first face that shines
    int face = first;
    do {
        bool shines = emits(face);
        vec3 other = normalOf(face);
        n = shines && !found ? other : n;
        found = found || shines;
        onePlane = onePlane && (!shines || dot(n, other) > kOnePlane);
    } while (++face < end);
    face = first;
    do parts[face] = onePlane ? 0u : 1u;
    while (++face < end);
#else
    vec2 sums = vec2(0.0);  // as rays meet it, as it is
    int face = first;
    do sums += emits(face) ? unpackHalf2x16(parts[face]) : vec2(0.0);
    while (++face < end);
    float part = clamp(sums.y / max(sums.x, 1e-6), kLeast, kMost);
    face = first;
    do parts[face] = floatBitsToUint(sums.x > 0.0 ? part : 1.0);
    while (++face < end);
#endif
}
#endif
