// SPDX-License-Identifier: MIT
// What the passes of the surface voxelizer share: slots, lists, and the index of an invocation.
//
//   surface_setup    triangle -> grid coordinates; small ones: fragments; big ones: tiles of 8 x 8 columns
//   surface_tiles    tile -> fragments
//   surface_count, surface_scan, surface_bricks   occupancy -> brickWord, list of occupied bricks
//   surface_clip     fragment -> what of the triangle is in the voxel, chained to its voxel
//   surface_count, surface_scan, surface_faces    directions -> voxRec, owner of each face
//   surface_resolve  face -> its chain, summed up
//   surface_layers   face in which something is covered -> what is seen, summed up again; face whose bounds
//                    are too wide -> bounds that fit
//
// Updates of what changed (SURFACE_UPDATE 1; docs/theory/2_voxels.md, "Updates"):
//   surface_drop     voxel in a dirty brick -> chain without the fragments of changed instances
//   surface_setup, surface_tiles             of changed instances only; fragments take free slots
//   surface_count, surface_scan, surface_bricks   as above
//   surface_carry    brick -> chains under their new numbers
//   surface_clip     new fragments only
//   surface_count, surface_scan, surface_faces    as above
//   surface_copy     face of an unchanged voxel, from its place before
//   surface_resolve, surface_layers          faces of changed voxels
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
#define SURFACE_LAYER_LIST 14  // resolve, layers: faces to be done again
// Updates
#define SURFACE_RUNS 13            // setup: (instance, its first place in the work) per changed instance
#define SURFACE_FREE_LIST 15       // setup, tiles, clip, drop: slots of dropped fragments
#define SURFACE_CHANGED_BRICKS 10  // clip, drop: bit per brick
#define SURFACE_DIRTY_BRICKS 9     // drop: indices of bricks to search
#define SURFACE_STALE 11           // drop: bit per instance that changed
#define SURFACE_OLD_CHAINS 14      // carry
#define SURFACE_ORIGIN 12          // carry, faces: record that a voxel had before, ~0: none
#define SURFACE_WORK_LIST 11       // faces, resolve: faces to be summed up
#define SURFACE_UNIT_OLD_BRICKS 8
#define SURFACE_UNIT_OLD_FACES 8
#define SURFACE_UNIT_OLD_SOURCES 9
#define SURFACE_UNIT_OLD_RECORDS 10
// In the word of directions of a chain: the voxel's fragments changed in this update.
#define CHAIN_DIRTY 0x80000000u
#define CHAIN_DIRECTIONS 63u
// In place of a direction (0..5) of an owner.
#define OWNER_IS_FACE 7u

// Buffer textures: reading through them costs a third of a storage read on a software driver
#define SURFACE_UNIT_TRIANGLES 8
#define SURFACE_UNIT_PAIRS 9
#define SURFACE_UNIT_FRAGMENTS 10
#define SURFACE_UNIT_OWNERS 11

layout(std140) uniform SurfaceBlock { SurfaceConstants surface; };

// Sums of weights are integers in units of 2^-shift voxel sides; this is the largest shift.
#define SURFACE_FINEST_UNIT 26
// Weight beyond the area of the bounds, in voxel sides, that rounding explains.
#define SURFACE_LEAST_EXCESS 0.00390625
// Entry of the lists of surface_layers: index of the face, from bit 26 on how much coarser its units are than
// the finest. Faces in which something is covered stand from the buffer's first place on, those of which only
// the bounds are too wide from place faceCapacity - 1 downwards.

// Flags of a triangle, above the 24 bits of its instance.
#define TRIANGLE_TWO_SIDED VOXEL_TRIANGLE_TWO_SIDED
#define TRIANGLE_UNUSED 0x2000000u

// Linear index of this invocation; groups may be folded into y.
uint linearInvocation() {
    uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    return group * (gl_WorkGroupSize.x * gl_WorkGroupSize.y * gl_WorkGroupSize.z) + gl_LocalInvocationIndex;
}

// Slot of the i-th new fragment of an update: free ones first, then behind those in use.
#define FRAGMENT_SLOT(i)                                                         \
    ((i) < counters[SURFACE_FREE] ? freeSlots[counters[SURFACE_FREE] - 1u - (i)] \
                                  : counters[SURFACE_TAIL] + (i)-counters[SURFACE_FREE])

// Directions a normal faces, bit k (shared/voxels.h).
uint facingDirections(vec3 n) {
    const float t = VOXEL_FACING_THRESHOLD;
    return (n.x > t ? 1u : 0u) | (n.x < -t ? 2u : 0u) | (n.y > t ? 4u : 0u) | (n.y < -t ? 8u : 0u) |
           (n.z > t ? 16u : 0u) | (n.z < -t ? 32u : 0u);
}

// Normals of fragments: three 16-bit snorm numbers, cheaper to read than an octahedral one.
uint packSnorm16(float x) { return uint(int(floor(x * 32767.0 + 0.5))) & 0xffffu; }
float unpackSnorm16(uint bits) { return float(int(bits << 16) >> 16) * (1.0 / 32767.0); }
