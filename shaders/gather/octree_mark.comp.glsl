#version 450 core
// SPDX-License-Identifier: MIT
// Occupied voxels -> marks of the octree's nodes, and how many nodes and bricks each level has. One
// invocation per occupied voxel: in each level it marks the nodes whose bricks hold its texel, and above the
// coarsest level with bricks their parents. Bits are or-ed and counted once each: no order of invocations
// shows.
//   DIRECTIONAL  a brick per facing direction; else one for all
#ifndef DIRECTIONAL
#error DIRECTIONAL must be 0 or 1
#endif
layout(local_size_x = 64) in;  // before linear_index, which asks for it
#include "lib/linear_index.glsl"
#include "lib/radiance_octree.glsl"
#include "lib/voxel_grid.glsl"
#include "lib/voxel_record.glsl"
layout(std430) readonly buffer FaceTable { FaceRecord faces[]; };
layout(std430) readonly buffer RecordTable { uint records[]; };
layout(std430) buffer OctreeSlots { uint slots[]; };
// Nodes of each level, then bricks.
layout(std430) buffer OctreeCounts { uint counts[]; };

void mark(ivec3 node, int level, uint directions) {
    uint slot = octreeSlot(node, level);
    uint bits = OCTREE_MARKED | (directions << OCTREE_DIRECTION_SHIFT);
    if ((slots[slot] & bits) == bits) return;
    uint before = atomicOr(slots[slot], bits);
    if (before == 0u) atomicAdd(counts[level], 1u);
    uint added = directions & ~(before >> OCTREE_DIRECTION_SHIFT);
    if (added != 0u) atomicAdd(counts[OCTREE_LEVELS + level], uint(bitCount(added)));
}

void main() {
    uint index = linearIndex();
    if (index >= grid.voxelCount) return;
    uint record = records[index];
    uint directions = faceDirections(record);
    if (directions == 0u) return;  // triangles that touch the voxel, and no area
    ivec3 voxel = unpackVoxel(faces[faceBase(record)].voxel);
#if !DIRECTIONAL
    directions = 1u;
#endif
    for (int level = 0; level <= int(octree.topLevel); ++level) {
        // Above the coarsest level with bricks: the nodes above those.
        int above = max(level - int(octree.maxLevel), 0);
        ivec3 texel = voxel >> (level - above);
        int borders = octreeBorders(texel);
        int axes = borders;
        do {
            mark(octreeHolder(texel, axes) >> above, level, above > 0 ? 0u : directions);
            axes = octreeNextAxes(axes, borders);
        } while (axes >= 0);
    }
}
