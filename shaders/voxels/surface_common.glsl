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
//   surface_drop     voxel in an edited brick -> chain without the fragments of changed instances
//   surface_shift    of nested grids that move: masks and fragments under their new coordinates
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
#include "shared/scene.h"
#include "shared/voxels.h"

// Names of lists (src/voxels/surface_work.cpp, SurfaceVoxels::Impl::given):
//   CounterTable  SURFACE_* words   TriangleTable  triangles   TileTable  tiles of triangles   PairTable
//   (triangle, voxel)   MaskTable  bit per voxel   ChainTable  first fragment, directions; per voxel
//   FragmentTable   ChunkTable  sums of chunks   BrickTable  occupied bricks   OwnerTable  of faces
//   FaceMaterialTable material   LayerTable  faces to be done again
// of updates:
//   RunTable  (instance, its first place in the work) per changed instance   FreeTable  slots of dropped
//   fragments   ChangedTable  bit per brick   EditedTable  indices of bricks to search   StaleTable  bit per
//   instance that changed   ShiftedMaskTable   masks after surface_shift   OldChainTable   OriginTable  record
//   that a voxel had before, ~0: none   WorkTable   faces to be summed up
// Buffer textures of lists (triangles, pairs, fragments, owners): reading through them costs a third of a
// storage read on a software driver.

// In the word of directions of a chain: the voxel's fragments changed in this update.
#define CHAIN_EDITED 0x80000000u
#define CHAIN_DIRECTIONS 63u
// In place of a direction (0..5) of an owner.
#define OWNER_IS_FACE 7u

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
