#version 450 core
// SPDX-License-Identifier: MIT
// Marks of bricks -> list of the marked ones, and in place of each mark its number in the list plus 1. A second
// run with ARGUMENTS makes the group counts of the passes over the list: one group per brick, per 8 and per 64
// bricks. The order of the list depends on timing, what is computed from it does not.
#include "thesis/shaders/constants.h"
layout(local_size_x = 64) in;
layout(std140) uniform ThesisGridBlock { ThesisGrid grid; };
layout(std430) buffer BrickSlots { uint brickSlots[]; };
// [0] number of marked bricks, [1] and [2] of tiles (voxelize.comp.glsl), [4..12] indirect arguments, [16..] packed bricks
layout(std430) buffer BrickList { uint brickList[]; };

#ifndef ARGUMENTS
#error ARGUMENTS must be 0 or 1
#endif

void main() {
#if ARGUMENTS
    if (gl_GlobalInvocationID.x != 0u) return;
    // Rows of 1024 groups, far below the limit of 65,535 along one axis.
    for (uint i = 0u; i < 3u; ++i) {
        uint groups = (brickList[0] + (1u << (3u * i)) - 1u) >> (3u * i);
        brickList[4u + 3u * i] = min(groups, 1024u);
        brickList[5u + 3u * i] = (groups + 1023u) / 1024u;
        brickList[6u + 3u * i] = 1u;
    }
#else
    uvec3 bricks = uvec3(grid.boxSize.xyz) / THESIS_BRICK;
    uint index = gl_GlobalInvocationID.y * (gl_NumWorkGroups.x * 64u) + gl_GlobalInvocationID.x;
    if (index >= bricks.x * bricks.y * bricks.z || brickSlots[index] == 0u) return;
    uvec3 brick = uvec3(index % bricks.x, index / bricks.x % bricks.y, index / (bricks.x * bricks.y));
    uint number = atomicAdd(brickList[0], 1u);
    brickSlots[index] = number + 1u;
    brickList[16u + number] = brick.x | brick.y << 10 | brick.z << 20;
#endif
}
