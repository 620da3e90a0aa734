// SPDX-License-Identifier: MIT
// The octree that may store the radiance volume (cones.storage=octree): what C++ and GLSL share. Written by
// src/gather/radiance_octree.cpp, read through lib/radiance_octree.glsl. docs/theory/2_voxels.md, "The octree".
//
// A node at level l holds 4^3 texels of that level: node (i,j,k) the texels from 4 (i,j,k) on. What it keeps of
// them, for each facing direction in which there is something, is a brick of 5^3 texels: its own and the first
// behind them along each axis, so that hardware filters anywhere between its own. Neighbours hold shared
// texels twice. A node exists where one of those 5^3 texels may hold something; then its parent does, too.
// The root is the one node of level rootLevel; levels above the volume's coarsest have no bricks. A volume may
// have levels above the root's, up to topLevel: each is a node of its own, with its brick, and no children.
//
//   OctreeNodes   uvec2 per node, by level from topLevel down, in Morton order within:
//                 x  bits 0..23 number of the first child, 24..31 which of the eight there are (x + 2 y + 4 z)
//                 y  bits 0..25 number of the first brick, 26..31 for which directions there are any
//   radianceBricks  RGBA16F 3D texture of bricks, 2^rowBits to a row, as many rows to a slice
//   OctreeBricks  uint per brick: bits 0..24 slot of its node, 25..27 direction
//
// A slot is the number that a node would have if every node existed.
#pragma once
#include "shared/prelude.h"

#define OCTREE_NODE_BITS 2
#define OCTREE_NODE_EDGE 4
#define OCTREE_BRICK_EDGE 5
#define OCTREE_BRICK_TEXELS 125
// Levels below the root, at most: 1024 voxels are 256 nodes. Levels of the volume: 0 to 10.
#define OCTREE_DEEPEST 8
#define OCTREE_LEVELS 11

// Words of a slot while the tree is built: bits 0..25 the node's number + 1, 26..31 its directions. Before
// nodes are numbered, OCTREE_MARKED stands for any number.
#define OCTREE_MARKED 1u
#define OCTREE_NUMBER_MASK 0x3ffffffu
#define OCTREE_DIRECTION_SHIFT 26
// Words of a node and of OctreeBricks.
#define OCTREE_CHILD_MASK 0xffffffu
#define OCTREE_CHILDREN_SHIFT 24
#define OCTREE_SLOT_MASK 0x1ffffffu
#define OCTREE_BLOCK_SHIFT 25

CONELIGHT_SHARED_BEGIN

struct RadianceOctree {
    vec3 inverseTextureSize;  // of radianceBricks, 1/texels
    uint rootLevel;
    // ---- 16 B
    uint topLevel;
    uint maxLevel;  // coarsest with bricks
    uint rowBits;
    uint slots;
    // ---- 32 B
    uint slotsPerChunk;  // prefix sums: slots one invocation adds up
    uint level;          // that is filled, and its bricks
    uint firstBrick;
    uint brickCount;
};  // 48 B

CONELIGHT_SHARED_END
#ifdef __cplusplus
static_assert(sizeof(conelight::gpu::RadianceOctree) == 48);
#endif
