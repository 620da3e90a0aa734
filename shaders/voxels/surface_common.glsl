// SPDX-License-Identifier: MIT
// What the passes of the surface voxelizer share: slots, lists, and the index of an invocation.
//
//   surface_setup    triangle -> grid coordinates; small ones: fragments; big ones: tiles of 8 x 8 columns
//   surface_tiles    tile -> fragments
//   surface_count, surface_scan, surface_bricks   occupancy -> brickWord, list of occupied bricks
//   surface_clip     fragment -> what of the triangle is in the voxel, chained to its voxel
//   surface_count, surface_scan, surface_faces    directions -> voxRec, owner of each face
//   surface_resolve  face -> its chain, summed up
//
// A fragment is a pair (triangle, voxel). Lists are filled in any order; everything that survives is ordered
// by prefix sums or summed in integers.
#include "shared/bindings.h"
#include "shared/scene.h"
#include "shared/voxels.h"

#define SURFACE_COUNTERS 8
#define SURFACE_TRIANGLES 9
#define SURFACE_TILE_LIST 10
#define SURFACE_PAIRS 11
#define SURFACE_MASKS 12
#define SURFACE_CHAINS 13
#define SURFACE_FRAGMENT_DATA 14
#define SURFACE_CHUNKS 15
// Numbers used again by passes that need few of the above
#define SURFACE_BRICK_LIST 10
#define SURFACE_OWNERS 10
#define SURFACE_FACE_SOURCES 9
// Buffer textures: reading through them costs a third of a storage read on a software driver
#define SURFACE_UNIT_TRIANGLES 8
#define SURFACE_UNIT_PAIRS 9
#define SURFACE_UNIT_FRAGMENTS 10
#define SURFACE_UNIT_OWNERS 11

layout(std140, binding = BINDING_PASS) uniform SurfaceBlock { SurfaceConstants surface; };

// Flags of a triangle, above the 24 bits of its instance.
#define TRIANGLE_TWO_SIDED 0x1000000u
#define TRIANGLE_UNUSED 0x2000000u

// Linear index of this invocation; groups may be folded into y.
uint linearInvocation() {
    uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    return group * (gl_WorkGroupSize.x * gl_WorkGroupSize.y * gl_WorkGroupSize.z) + gl_LocalInvocationIndex;
}

// Directions a normal faces, bit k (shared/voxels.h).
uint facingDirections(vec3 n) {
    const float t = VOXEL_FACING_THRESHOLD;
    return (n.x > t ? 1u : 0u) | (n.x < -t ? 2u : 0u) | (n.y > t ? 4u : 0u) | (n.y < -t ? 8u : 0u) |
           (n.z > t ? 16u : 0u) | (n.z < -t ? 32u : 0u);
}

// Normals of fragments: three 16-bit snorm numbers, cheaper to read than an octahedral one.
uint packSnorm16(float x) { return uint(int(floor(x * 32767.0 + 0.5))) & 0xffffu; }
float unpackSnorm16(uint bits) { return float(int(bits << 16) >> 16) * (1.0 / 32767.0); }
