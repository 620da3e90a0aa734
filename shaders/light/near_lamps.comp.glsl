#version 450 core
// SPDX-License-Identifier: MIT
// Voxels about a lamp: the light of points and spots on their faces, as a mean over what of the triangles they hold
// (docs/theory/3_light.md, "Lamps near voxels"). A face stands for surfaces all about the lamp with one point and one
// normal; light/inject_light.comp.glsl asks there, which may be next to the lamp where no surface is.
//
// One invocation per lamp, level, voxel of the block around it, and direction; of several lamps about one voxel the first
// does it.
// BULBS 1: instead, the light of spheres smaller than the voxels.
#ifndef BULBS
#error BULBS must be 0 or 1
#endif
layout(local_size_x = 64) in;  // before linear_index, which asks for it
#define NEAR_TRIANGLES 1
#define CLIP_SOLID_ANGLE 1
// For glass and triangles, before the others.
#include "lib/dot.glsl"
#include "lib/scene_tables.glsl"
#include "lib/surface_array.glsl"
// The others.
#include "lib/clip.glsl"
#include "lib/lights.glsl"
#include "lib/linear_index.glsl"
#include "lib/ray_query.glsl"
#include "lib/voxel_grid.glsl"
#include "lib/voxel_record.glsl"
#include "shared/irradiance.h"
#include "shared/lamps.h"
layout(std430) readonly buffer FaceTable { FaceRecord faces[]; };
layout(std430) buffer LitFaceTable { LitFace litFaces[]; };
#if BULBS
layout(std430) buffer CachedDirect { uint cachedDirect[]; };
#else
layout(std430) readonly buffer CachedDirect { uint cachedDirect[]; };
#endif
uniform usamplerBuffer voxelFaceMaterials;

const float kLeastArea = 4.0 / 65535.0;  // that a face can tell (lib/voxel_record.glsl), voxel sides

// A voxel in the coordinates of its level.
struct Cell {
    ivec3 voxel;
    vec4 place;  // of the level: corner and edge, voxels of level 0
};

vec3 cellFromWorld(Cell cell, vec3 world) {
    return (gridFromWorld(world) - cell.place.xyz) / cell.place.w - (vec3(cell.voxel) + 0.5);
}
vec3 worldFromCell(Cell cell, vec3 p) {
    return worldFromGrid(cell.place.xyz + cell.place.w * (vec3(cell.voxel) + 0.5 + p));
}
bool isNear(Cell cell, Light lamp) {
    ivec3 off = abs(ivec3(floor(cellFromWorld(cell, lamp.position) + 0.5)));
    bool near = 2 * max(off.x, max(off.y, off.z)) < NEAR_LAMP_BLOCK;
#if BULBS
    near = near && isSphere(lamp) && length(lamp.halfU) < cell.place.w * grid.voxelSize;
#endif
    return near;
}

// The lamps in the table, from x on to below y.
uvec2 lampRange() {
#if BULBS
    return lighting.lightEnds.zw;
#else
    return uvec2(0u, lighting.lightEnds.y);
#endif
}

// A fragment (voxels/surface_clip.comp.glsl).
struct Piece {
    float area;   // voxel sides
    vec3 normal;  // unit
    vec3 center;  // from the voxel's centre, voxels
    bool twoSided;
    int triangle;
};

Piece pieceOf(int slot) {
    uvec4 a = texelFetch(voxelFragments, 2 * slot);
    uvec4 b = texelFetch(voxelFragments, 2 * slot + 1);
    vec3 n = vec3(unpackSnorm2x16(a.w), unpackSnorm2x16(b.x).x);
    vec3 center = vec3(b.x >> 16, b.y & 0xffffu, b.y >> 16) * (1.0 / 65535.0) - 0.5;
    return Piece(uintBitsToFloat(a.y), n / max(length(n), 1e-6), center, (a.z & FRAGMENT_TWO_SIDED) != 0u,
                 int(texelFetch(voxelPairs, slot).x));
}

// Solid angle of a piece, seen from a lamp, all in voxels from the voxel's centre; and its whole area.
vec2 pieceSeen(Cell cell, Piece piece, vec3 lamp) {
    TriangleCorners c = triangleCorners(piece.triangle);
    vec3 q0 = (c.origin - cell.place.xyz) / cell.place.w - (vec3(cell.voxel) + 0.5);
    vec3 e1 = c.edge1 / cell.place.w, e2 = c.edge2 / cell.place.w;
    vec3 n = cross(e1, e2);
    clipEye = lamp;
    clipMiddle = piece.center;
    ClippedPolygon polygon = clipToVoxel(q0, q0 + e1, q0 + e2, n / max(length(n), 1e-20));
    return vec2(abs(polygon.solidAngle), polygon.area);
}

// What of a lamp a place sees.
float visibleOf(Light light, uint number, vec3 position, vec3 normal) {
#if !LIGHTS_SHADOWS
    return 1.0;
#elif BULBS
    uint count = light.sampleGrid * light.sampleGrid;
    float sum = 0.0;
    for (uint k = 0u; k < count; ++k)
        sum += shadowVisibilityRect(light, k, rectSamplePoint(light, k), position, normal);
    return sum / float(count);
#else
    Receiver r = Receiver(position, normal, normal, normal, vec2(0.0));
    return number < lighting.lightEnds.x ? pointVisibility(r, light, number)
                                         : spotVisibility(r, light, number);
#endif
}

// What it sends in the direction l from a place that is d2 away, W/sr.
vec3 sentBy(Light light, vec3 l, float d2) {
#if BULBS
    return light.intensity * rectArea(light);
#else
    return light.intensity * (distanceFalloff(light, d2) * d2 * spotFalloff(light, l));
#endif
}

// What a lamp sends to a piece, W/m^2 over its area.
vec3 pieceIrradiance(Cell cell, Piece piece, vec3 normal, uint number) {
    Light light = lightOfTable(number);
    vec3 lamp = cellFromWorld(cell, light.position);
    vec3 position = worldFromCell(cell, piece.center);
    vec3 l = light.position - position;
    float d2 = max(dot(l, l), 1e-12);
    l *= inversesqrt(d2);
    if (dot(lamp - piece.center, normal) <= 0.0) return vec3(0.0);
    float edge = cell.place.w * grid.voxelSize;
    vec2 seen = pieceSeen(cell, piece, lamp);
    Receiver r = Receiver(position, normal, normal, normal, vec2(0.0));
    vec3 intensity = sentBy(light, l, d2) * visibleOf(light, number, position, normal);
    return throughGlass(intensity, r, l, sqrt(d2)) * (seen.x / max(seen.y * edge * edge, 1e-12));
}

// Of one of the lamps about the voxel, sum over the pieces that look to a direction: W/m^2 times their part of it, voxel
// sides.
vec3 sumOfPieces(Cell cell, uint chain, vec3 direction, uint number) {
    vec3 sum = vec3(0.0);
    uint link = chain;
    while (link != 0u) {
        int slot = int(link) - 1;
        link = texelFetch(voxelFragments, 2 * slot).x;
        Piece piece = pieceOf(slot);
        float facing = dot(piece.normal, direction);
        bool counts = piece.area > 0.0 && (piece.twoSided ? abs(facing) : facing) > VOXEL_FACING_THRESHOLD;
        if (!counts) continue;
        vec3 normal = facing < 0.0 ? -piece.normal : piece.normal;
        sum += piece.area * facing * facing * pieceIrradiance(cell, piece, normal, number);
    }
    return sum;
}

// Of all these lamps. `area`: what of the pieces is the face's own, which is less than all where some hide others.
vec3 nearIrradiance(Cell cell, uint chain, vec3 direction, float area) {
    vec3 sum = vec3(0.0);
    uvec2 range = lampRange();
    for (uint i = range.x; i < range.y; ++i)
        if (isNear(cell, lightOfTable(i))) sum += sumOfPieces(cell, chain, direction, i);
    return sum / max(area, kLeastArea);
}

// At the middle of a face: of all other lamps; with BULBS of these, which the face has already.
vec3 middleIrradiance(Cell cell, FaceRecord face) {
    vec3 normal = faceNormal(face);
    Receiver receiver = Receiver(worldFromGrid(faceCenter(face)), normal, normal, normal, kShadowVoxelLift);
    Brdf none;
    DirectLight sum = DirectLight(vec3(0.0), vec3(0.0));
    uvec2 range = lampRange();
    for (uint i = range.x; i < range.y; ++i) {
#if BULBS
        if (isNear(cell, lightOfTable(i))) addRect(sum, false, receiver, none, lightOfTable(i));
#else
        if (isNear(cell, lightOfTable(i))) continue;
        if (i < lighting.lightEnds.x)
            addPoint(sum, false, receiver, none, lightOfTable(i), i);
        else
            addSpot(sum, false, receiver, none, lightOfTable(i), i);
#endif
    }
    FOR_DIRECTIONAL_LIGHTS(addDirectional(sum, false, receiver, none, light, number))
    return sum.irradiance;
}

void lightFace(Cell cell, uint chain, int direction, uint face) {
    float area = unpackArea(texelFetch(voxelFaceMaterials, int(face)));
    vec3 near = nearIrradiance(cell, chain, directionVector(direction), area);
    vec3 middle = middleIrradiance(cell, faces[face]);
    vec3 reflectance = unpackAlbedo(litFaces[face].albedo) * (1.0 / 3.14159265358979);
    vec3 steady = unpackRgb9e5(cachedDirect[face]);
#if BULBS
    vec3 more = reflectance * (near - middle);
    litFaces[face].radiance = packRgb9e5(max(unpackRgb9e5(litFaces[face].radiance) + more, vec3(0.0)));
    cachedDirect[face] = packRgb9e5(max(steady + more, vec3(0.0)));
#else
    litFaces[face].radiance = packRgb9e5(steady + reflectance * (near + middle));
#endif
}

void main() {
    // The voxel, of the block around a lamp
    const int block = NEAR_LAMP_BLOCK;
#if NESTED_GRIDS
    uint levels = voxelLevels.count;
    ivec3 size = ivec3(levelSize());
#else
    const uint levels = 1u;
    ivec3 size = gridSize();
#endif
    int direction = int(linearIndex() % 6u);
    uint index = linearIndex() / 6u;
    int place = int(index % uint(block * block * block));
    int level = int(index / uint(block * block * block) % levels);
    uvec2 range = lampRange();
    uint lamp = range.x + index / (uint(block * block * block) * levels);
    if (lamp >= range.y) return;
    Cell cell;
#if NESTED_GRIDS
    cell.place = levelPlace(level);
#else
    cell.place = vec4(0.0, 0.0, 0.0, 1.0);
#endif
    cell.voxel = ivec3(0);
    cell.voxel = ivec3(floor(cellFromWorld(cell, lightPosition(lamp)) + 0.5)) +
                 ivec3(place % block, place / block % block, place / (block * block)) - block / 2;
    if (any(lessThan(cell.voxel, ivec3(0))) || any(greaterThanEqual(cell.voxel, size))) return;

#if NESTED_GRIDS
    ivec3 stored = storedVoxel(cell.voxel, level);
#else
    ivec3 stored = cell.voxel;
#endif
    // Its face
    uvec4 word = imageLoad(voxelBrickImage, stored >> 2);
    if (!brickHas(word.xy, bitOfVoxel(stored))) return;
    int recordIndex = int(voxelRecordIndex(word, bitOfVoxel(stored)));
    uint record = texelFetch(voxelRecords, recordIndex).x;
    if ((faceDirections(record) >> direction & 1u) == 0u) return;
    for (uint i = range.x; i < lamp; ++i)
        if (isNear(cell, lightOfTable(i))) return;
#if BULBS
    if (!isNear(cell, lightOfTable(lamp))) return;
#endif

#if GLASS
    veilNear = kVeilNearVoxels * cell.place.w * grid.voxelSize;
#endif
    // Light it
    lightFace(cell, texelFetch(voxelChains, recordIndex).x, direction, faceIndex(record, direction));
}
