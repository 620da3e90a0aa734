// SPDX-License-Identifier: MIT
// Which texels of the octree's bricks an invocation fills from the next finer level (shared/radiance_octree.h).
#include "lib/radiance_octree.glsl"
layout(std430) readonly buffer OctreeBricks { uint brickNodes[]; };

// Places in a texture of bricks: of a texel of the level that is filled, and of the first of the eight that it is
// made of, which lie in one node of the finer level.
struct OctreeLevelPlace {
    ivec3 coarse;
    ivec3 fine;
    int block;   // direction
    bool empty;  // there are no eight
};

// Texel number `index` of all bricks of the level; whether there are so many.
bool octreeTexelToFill(uint index, out OctreeLevelPlace t) {
    if (index >= octree.brickCount * uint(OCTREE_BRICK_TEXELS)) return false;
    uint brick = octree.firstBrick + index / uint(OCTREE_BRICK_TEXELS);
    int i = int(index % uint(OCTREE_BRICK_TEXELS));
    ivec3 inBrick = ivec3(i % OCTREE_BRICK_EDGE, (i / OCTREE_BRICK_EDGE) % OCTREE_BRICK_EDGE,
                          i / (OCTREE_BRICK_EDGE * OCTREE_BRICK_EDGE));
    int level = int(octree.level);
    uint entry = brickNodes[brick];
    t.block = int(entry >> OCTREE_BLOCK_SHIFT);
    t.coarse = octreeCorner(brick) + inBrick;
    ivec3 texel = OCTREE_NODE_EDGE * octreeNodeOfSlot(entry & OCTREE_SLOT_MASK, level) + inBrick;
    uvec2 finer = octreeNode((2 * texel) >> OCTREE_NODE_BITS, level - 1);
    t.empty = !octreeHas(finer, t.block);
    t.fine = t.empty ? ivec3(0) : octreeCornerOf(finer, t.block) + ((2 * texel) & (OCTREE_NODE_EDGE - 1));
    return true;
}
