#version 450 core
// SPDX-License-Identifier: MIT
// What part of its emission a face shows to rays, so that a lamp's voxels send what the lamp sends
// (docs/theory/4c_estimator.md, (4.36)). Where several plane pieces stand for a curved surface or for an
// edge, they reach beyond it, and to rays they are larger than the surface. Where a lamp is closer to what
// hides it than a voxel, faces show what is hidden: the inside of a bulb, a bulb within a pipe.
//
// STEP 0, per brick of the grid: marks the faces whose size is asked for, those of bricks in which not all
// that shines lies in one plane. 1, per face: its size as rays meet it. 2, per fragment: lists those that
// shine. 3, per fragment of the list: what it sends, and what part of that gets away from the triangles around
// it. 4, per brick: what gets away, over what the faces would show, the same for all its faces. Faces of one
// brick are next to each other.
#ifndef STEP
#error STEP must be 0 to 4
#endif
#if STEP == 3
#define NEAR_TRIANGLES 1
#endif
layout(local_size_x = 64) in;
#include "lib/clip.glsl"
#include "lib/dot.glsl"
#include "lib/linear_index.glsl"
#include "lib/plane_piece.glsl"
#include "lib/random.glsl"
#include "lib/scene_tables.glsl"
#include "lib/surface_array.glsl"
// These ask for the tables.
#include "lib/ray_query.glsl"
#include "lib/tangent_frame.glsl"
uniform usamplerBuffer voxelFaceMaterials;
// Per face. After step 0: 1 or 0; 1: the area as rays meet it (voxel sides), a float, negative where it is
// not asked for; 4: the part of the emission that it shows, a float.
layout(std430) buffer EmissionFit { uint parts[]; };
#if STEP == 2 || STEP == 3
// Fragments that shine, in any order.
layout(std430) buffer ShiningFragments { uint shining[]; };
#endif
#if STEP >= 2
// Per face: areas that would send, with the face's emission, what its fragments send, and what of that gets
// away; in voxel sides / 2^16.
layout(std430) buffer SentLight {
    uint groupsX, groupsY, groupsZ;  // of the indirect dispatch of step 3
    uint shiningCount;
    uint fragmentSlots;  // places of fragments; those not in use have no area
    uint pad;
    uvec2 sentLight[];
};
const uint kRowGroups = 64u;  // groupsX
const float kSentUnit = 65536.0;
#endif

const float kOnePlane = 0.98;    // cosine of normals up to which faces are of one plane
const int kRays = 16;            // per face; sums over a brick are within 3 %, over a lamp within 1 %
const float kFromOutside = 1.5;  // voxels: what reaches beyond the surface is nearer

// Walks: so far without meeting a triangle is away, voxels; turns until one is given up; walks per voxel side
// of a fragment, and per fragment. What is sent into a narrow gap takes many turns to get out of it, and is not shut in.
// Software drivers end all loops of an invocation together after 65,535 turns: these leave room for chains of 150 where
// a lamp is shut in, and more elsewhere.
const float kWalkStart = 1e-3;  // off the surface, voxels
const float kWalkReach = 2.5;
const int kWalkTurns = 40;
const float kWalks = 8.0;
const int kLeastWalks = 2, kMostWalks = 4;
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
#if NESTED_GRIDS
        vec4 voxel = voxelPlace(r.w);
        vec3 from = voxel.xyz + voxel.w * (0.5 + fromDominant(point, axis) + kFromOutside * leaves);
        float reach = voxel.w * (kFromOutside + 0.5);
#else
        vec3 from = vec3(unpackVoxel(r.w)) + 0.5 + fromDominant(point, axis) + kFromOutside * leaves;
        float reach = kFromOutside + 0.5;
#endif
        VoxelHit hit = traceVoxels(Ray(from, -leaves, inside ? reach : -1.0, vec3(0.0)));
        // What else stands before the lamp takes light of it, but does not make it smaller.
        bool counts = inside && hit.face >= 0 && emits(max(hit.face, 0));
        tried += counts ? 1.0 : 0.0;
        found += counts && hit.face == face ? 1.0 : 0.0;
    } while (++i < (asked ? kRays : 1));
    return pieceArea(m, offset, lower, upper) / abs(m.z) * (tried > 0.0 ? found / tried : 1.0);
}

void main() {
    int face = int(min(linearIndex(), max(grid.faceCount, 1u) - 1u));
    bool used = linearIndex() < grid.faceCount;
    bool asked = used && parts[face] != 0u && emits(face);
    float seen = seenArea(face, asked);
    if (used) parts[face] = floatBitsToUint(asked ? seen : -1.0);
}
#elif STEP == 2
uniform usamplerBuffer voxelFragments;
void main() {
    uint slot = linearIndex();
    int i = 2 * int(min(slot, max(fragmentSlots, 1u) - 1u));
    bool shines = slot < fragmentSlots && texelFetch(voxelFragments, i).y != 0u &&
                  unpackRgb9e5(texelFetch(voxelFragments, i + 1).w) != vec3(0.0);
    if (!shines) return;
    uint place = atomicAdd(shiningCount, 1u);
    shining[place] = slot;
    atomicMax(groupsY, place / (kRowGroups * gl_WorkGroupSize.x) + 1u);
}
#elif STEP == 3
// A direction of density cos / pi about n.
vec3 walkDirection(vec3 n, vec2 xi) {
    vec3 u, v;
    tangentFrame(n, u, v);
    float across = sqrt(xi.x);
    float phi = 6.28318530718 * xi.y;
    return across * cos(phi) * u + across * sin(phi) * v + sqrt(max(1.0 - xi.x, 0.0)) * n;
}

// Share of the walks that start at a point with normal n, and turn where they meet triangles, that get away.
// The others are shut in with the lamp: light within a bulb, or of a bulb within a pipe.
float leavingShare(vec3 point, vec3 n, uint seed, int walks) {
#if NESTED_GRIDS
    float edge = voxelEdgeAt(point);
#else
    const float edge = 1.0;
#endif
    int away = 0;
    int i = 0;
    do {
        vec3 normal = n;
        vec3 origin = point + kWalkStart * edge * n;
        bool goesOn = i < walks;
        int turns = 0;
        do {
            vec3 direction = walkDirection(normal, sequencePoint(seed + uint(turns) * 0x85ebca6bu, uint(i)));
            bool reached;
            TriangleCrossing hit =
                traceTriangles(Ray(origin, direction, goesOn ? kWalkReach * edge : -1.0, vec3(0.0)), reached);
            away += goesOn && reached ? 1 : 0;
            goesOn = goesOn && hit.triangle >= 0;
            normal = goesOn ? normalize(hit.normal) : n;
            origin += (goesOn ? hit.t : 0.0) * direction + kWalkStart * edge * normal;
        } while (goesOn && ++turns <= kWalkTurns);
    } while (++i < walks);
    return float(away) / float(max(walks, 1));
}

// Adds what a fragment sends to the sides that n leans to, and what of it gets away, to its voxel's faces.
// Sums are of integers: they do not depend on the order.
void addSent(ivec3 voxel, vec3 n, float area, float brightness, float leaving) {
    uvec4 word = imageLoad(voxelBrickImage, voxel >> 2);
    uint record = texelFetch(voxelRecords, int(voxelRecordIndex(word, bitOfVoxel(voxel)))).x;
    uint directions = faceDirections(record);
    int axis = 0;
    do {
        int direction = sideOfAxis(axis, n);
        float facing = dot(n, directionVector(direction));
        bool has = facing > VOXEL_FACING_THRESHOLD && (directions >> direction & 1u) != 0u && area > 0.0;
        int face = int(faceBase(record)) + bitCount(directions & ((1u << direction) - 1u));
        vec3 emission = unpackEmission(texelFetch(voxelFaceMaterials, has ? face : 0));
        // The faces of a voxel add up to the surface.
        float sent = area * facing * facing * brightness / max(dot(emission, vec3(1.0 / 3.0)), 1e-12);
        sent = min(sent, 8.0) * kSentUnit;
        if (has) {
            atomicAdd(sentLight[face].x, uint(sent + 0.5));
            atomicAdd(sentLight[face].y, uint(sent * leaving + 0.5));
        }
    } while (++axis < 3);
}

void main() {
    bool shines = linearIndex() < shiningCount;
    int slot = int(shining[shines ? linearIndex() : 0u]);
    uvec4 a = texelFetch(voxelFragments, 2 * slot);
    uvec4 b = texelFetch(voxelFragments, 2 * slot + 1);
    uvec2 pair = texelFetch(voxelPairs, slot).xy;
    float brightness = dot(unpackRgb9e5(b.w), vec3(1.0 / 3.0));
    float area = shines ? uintBitsToFloat(a.y) : 0.0;
    bool twoSided = (a.z & 0x40000000u) != 0u;
    vec3 n = normalize(vec3(unpackSnorm2x16(a.w), unpackSnorm2x16(b.x).x));
    ivec3 voxel = unpackVoxel(pair.y);
    vec3 point = vec3(b.x >> 16, b.y & 0xffffu, b.y >> 16) * (1.0 / 65535.0);
#if NESTED_GRIDS
    vec4 place = voxelPlace(pair.y);
    point = place.xyz + place.w * point;
#else
    point = vec3(voxel) + point;
#endif
    uint seed = randomHash(pair.x) ^ randomHash(pair.y);
    int walks = shines ? clamp(int(area * kWalks + 0.5), kLeastWalks, kMostWalks) : 0;
    int side = 0;
    do {
        vec3 outwards = side == 0 ? n : -n;
        float leaving = leavingShare(point, outwards, seed + uint(side), walks);
        addSent(voxel, outwards, area, brightness, leaving);
    } while (++side < (shines && twoSided ? 2 : 1));
}
#else
void main() {
    uint brick = linearIndex();
    ivec3 bricks = storedBricks();
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
    vec2 sums = vec2(0.0);  // of what faces show, of what gets away
    int face = first;
    do {
        vec2 sent = vec2(sentLight[face]) / kSentUnit;
        float shown = uintBitsToFloat(parts[face]);
        float emission = dot(unpackEmission(texelFetch(voxelFaceMaterials, face)), vec3(1.0 / 3.0));
        float leaving = sent.y / max(sent.x, 1e-9);
        sums += shown >= 0.0 ? emission * vec2(leaving * shown, sent.y) : vec2(0.0);
    } while (++face < end);
    float fit = sums.x > 0.0 ? clamp(sums.y / sums.x, kLeast, kMost) : 1.0;
    face = first;
    do {
        vec2 sent = vec2(sentLight[face]);
        float leaving = sent.y / max(sent.x, 1e-9);
        parts[face] = floatBitsToUint(leaving * (uintBitsToFloat(parts[face]) >= 0.0 ? fit : 1.0));
    } while (++face < end);
#endif
}
#endif
