#version 450 core
// SPDX-License-Identifier: MIT
// Marks of the octree's nodes -> nodes and bricks with numbers, by a prefix sum over all slots.
//   STEP 0  one invocation per chunk of slots: its nodes and bricks
//        1  one group: sums of chunks -> their starts
//        2  one invocation per chunk: numbers; bricks of each node, node of each brick
//        3  one invocation per slot: children of each node, which have numbers in a row
#ifndef STEP
#error STEP must be 0, 1, 2 or 3
#endif
#if STEP == 1
#include "shared/prefix_sum.h"
layout(local_size_x = PREFIX_GROUP) in;
#else
layout(local_size_x = 64) in;  // before linear_index, which asks for it
#include "lib/linear_index.glsl"
#endif
#include "shared/radiance_octree.h"
layout(std140) uniform RadianceOctreeBlock { RadianceOctree octree; };
layout(std430) buffer OctreeSlots { uint slots[]; };
#if STEP <= 2
layout(std430) buffer OctreeChunks { uvec2 chunks[]; };
#endif
#if STEP == 1
#define PREFIX_TYPE uvec2
#include "lib/prefix_sum.glsl"
#endif
#if STEP >= 2
layout(std430) writeonly buffer OctreeNodes { uvec2 nodes[]; };
#endif
#if STEP == 2
layout(std430) writeonly buffer OctreeBricks { uint bricks[]; };
#endif

#if STEP == 0 || STEP == 2
void main() {
    uint chunk = linearIndex();
    uint slot = chunk * octree.slotsPerChunk;
    uint end = min(slot + octree.slotsPerChunk, octree.slots);
    if (slot >= end) return;
#if STEP == 0
    uvec2 sum = uvec2(0u);
    do {
        uint word = slots[slot];
        if (word != 0u) sum += uvec2(1u, uint(bitCount(word >> OCTREE_DIRECTION_SHIFT)));
        ++slot;
    } while (slot < end);
    chunks[chunk] = sum;
#else
    uvec2 next = chunks[chunk];
    do {
        uint directions = slots[slot] >> OCTREE_DIRECTION_SHIFT;
        if (slots[slot] != 0u) {
            slots[slot] = (next.x + 1u) | (directions << OCTREE_DIRECTION_SHIFT);
            nodes[next.x] = uvec2(0u, next.y | (directions << OCTREE_DIRECTION_SHIFT));
            ++next.x;
        }
        while (directions != 0u) {
            bricks[next.y] = slot | (uint(findLSB(directions)) << OCTREE_BLOCK_SHIFT);
            directions &= directions - 1u;
            ++next.y;
        }
        ++slot;
    } while (slot < end);
#endif
}
#elif STEP == 1
void main() { prefixChunks((octree.slots + octree.slotsPerChunk - 1u) / octree.slotsPerChunk); }
#else
void main() {
    uint slot = linearIndex();
    if (slot >= octree.slots) return;
    uint number = slots[slot] & OCTREE_NUMBER_MASK;
    // Nodes above the root have no children.
    uint root = octree.topLevel - octree.rootLevel;
    uint firstChild = 8u * (slot - root) + 1u + root;
    if (number == 0u || slot < root || firstChild >= octree.slots) return;
    uint children = 0u;
    uint first = 0u;
    for (int i = 7; i >= 0; --i) {
        uint child = slots[firstChild + uint(i)] & OCTREE_NUMBER_MASK;
        if (child != 0u) {
            children |= 1u << i;
            first = child - 1u;
        }
    }
    nodes[number - 1u].x = first | (children << OCTREE_CHILDREN_SHIFT);
}
#endif
