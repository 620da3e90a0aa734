#version 450 core
// SPDX-License-Identifier: MIT
// Sums of the voxelizer -> marks of the octree's nodes: those whose bricks hold a voxel with surface, or what is
// averaged of it. One group per marked brick; the brick as a whole is a texel of level 3, and marks from there on.
#include "thesis/shaders/constants.h"
layout(local_size_x = 8, local_size_y = 8, local_size_z = 8) in;
layout(std140) uniform ThesisGridBlock { ThesisGrid grid; };
layout(std430) readonly buffer SumTable { uint sums[]; };
layout(std430) readonly buffer BrickList { uint brickList[]; };
// Per brick of the list: whether one of its voxels has marked for all.
layout(std430) buffer BrickMarks { uint brickMarks[]; };
#include "lib/octree_mark.glsl"

const int kBrickLevel = 3;  // whose texels are bricks

void main() {
    uint index = gl_WorkGroupID.y * 1024u + gl_WorkGroupID.x;
    if (index >= brickList[0]) return;
    uint bits = brickList[16u + index];
    ivec3 brick = ivec3(bits & 1023u, bits >> 10 & 1023u, bits >> 20);
    ivec3 voxel = grid.boxMin.xyz + brick * THESIS_BRICK + ivec3(gl_LocalInvocationID);
    int place = int(index) * THESIS_BRICK_VOXELS + int(gl_LocalInvocationIndex);
    int top = int(octree.topLevel);
    bool holds = sums[4 * place + 3] != 0u;
    int level = 0;
    while (holds) {
        octreeMarkHolders(voxel, level, 1u);
        ++level;
        bool isFirst = true;
        if (level == kBrickLevel) isFirst = atomicExchange(brickMarks[index], 1u) == 0u;
        holds = level <= top && isFirst;
    }
}
