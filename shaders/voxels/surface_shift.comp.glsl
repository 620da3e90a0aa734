// SPDX-License-Identifier: MIT
// Update of nested grids that move, behind surface_drop. One invocation per brick and slot of a fragment: masks of bricks
// that stay go to where these are stored from here on, and fragments get the new coordinates of their voxels.
#version 450
layout(local_size_x = 64) in;
#include "lib/voxel_address.glsl"
#include "voxels/surface_common.glsl"
#include "voxels/surface_scroll.glsl"
#if NESTED_GRIDS
layout(std430) readonly buffer CounterTable { uint counters[]; };
layout(std430) readonly buffer MaskTable { uvec2 masks[]; };
layout(std430) writeonly buffer ShiftedMaskTable { uvec2 shiftedMasks[]; };
layout(std430) buffer PairTable { uvec2 pairs[]; };
layout(std430) writeonly buffer FragmentTable { uint fragments[]; };

void shiftMask(uint index) {
    ivec3 stored = 4 * brickOfIndex(index, gridBricks());
    int level = levelOfStored(stored);
    ivec3 before = voxelBefore(withinLevel(stored, level), level);
    bool held = isInLevel(before);
    ivec3 brick = storedVoxel(held ? before : ivec3(0), level) >> 2;
    shiftedMasks[index] = held ? masks[brickIndex(brick, gridBricks())] : uvec2(0u);
}

// Those of slots that are free may lie anywhere.
void shiftFragment(uint slot) {
    ivec3 stored = unpackVoxel(pairs[slot].y);
    int level = levelOfStored(stored);
    ivec3 voxel = withinLevel(stored, level) + scroll.shifts[level].xyz;
    if (!isInLevel(voxel)) return;
    uint word = packVoxel(storedVoxel(voxel, level));
    pairs[slot].y = word;
    if (scroll.shifts[0].w != 0) fragments[8u * slot + 7u] = word;
}

void main() {
    uint index = linearInvocation();
    if (index < storedBrickCount()) shiftMask(index);
    if (index < min(counters[SURFACE_TAIL], surface.fragmentCapacity)) shiftFragment(index);
}
#else
void main() {}
#endif
