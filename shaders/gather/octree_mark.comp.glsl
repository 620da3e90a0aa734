#version 450 core
// SPDX-License-Identifier: MIT
// Occupied voxels -> marks of the octree's nodes, and how many nodes and bricks each level has. One
// invocation per occupied voxel: in each level it marks the nodes whose bricks hold its texel, and above the
// coarsest level with bricks their parents.
//   DIRECTIONAL  a brick per facing direction; else one for all
#ifndef DIRECTIONAL
#error DIRECTIONAL must be 0 or 1
#endif
layout(local_size_x = 64) in;  // before linear_index, which asks for it
#include "lib/linear_index.glsl"
#include "lib/octree_mark.glsl"
#include "lib/voxel_grid.glsl"
#include "lib/voxel_record.glsl"
layout(std430) readonly buffer FaceTable { FaceRecord faces[]; };
layout(std430) readonly buffer RecordTable { uint records[]; };

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
    for (int level = 0; level <= int(octree.topLevel); ++level) octreeMarkHolders(voxel, level, directions);
}
