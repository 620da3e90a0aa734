// SPDX-License-Identifier: MIT
// Marks of the octree's nodes before they are numbered, and how many nodes and bricks each level has
// (shared/radiance_octree.h). Bits are or-ed and counted once each: no order of invocations shows.
#include "lib/radiance_octree.glsl"
layout(std430) buffer OctreeSlots { uint slots[]; };
// Nodes of each level, then bricks.
layout(std430) buffer OctreeCounts { uint counts[]; };

void octreeMark(ivec3 node, int level, uint directions) {
    uint slot = octreeSlot(node, level);
    uint bits = OCTREE_MARKED | (directions << OCTREE_DIRECTION_SHIFT);
    if ((slots[slot] & bits) == bits) return;
    uint before = atomicOr(slots[slot], bits);
    if (before == 0u) atomicAdd(counts[level], 1u);
    uint added = directions & ~(before >> OCTREE_DIRECTION_SHIFT);
    if (added != 0u) atomicAdd(counts[OCTREE_LEVELS + level], uint(bitCount(added)));
}

// The nodes of a level whose bricks hold the texel of a voxel; above the coarsest level with bricks, the nodes
// above those.
void octreeMarkHolders(ivec3 voxel, int level, uint directions) {
    int above = max(level - int(octree.maxLevel), 0);
    ivec3 texel = voxel >> (level - above);
    int borders = octreeBorders(texel);
    int axes = borders;
    do {
        octreeMark(octreeHolder(texel, axes) >> above, level, above > 0 ? 0u : directions);
        axes = octreeNextAxes(axes, borders);
    } while (axes >= 0);
}
