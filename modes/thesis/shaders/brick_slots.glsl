// SPDX-License-Identifier: MIT
// Bricks of the box that hold surface, and where the sums of their voxels lie. Before it: ThesisGrid `grid`.
// Per brick of the box: not 0 where it is marked, then its number in the list of bricks plus 1 (bricks.comp.glsl).
layout(std430) buffer BrickSlots { uint brickSlots[]; };

uint brickIndex(ivec3 brick) {
    ivec3 bricks = grid.boxSize.xyz / THESIS_BRICK;
    return uint((brick.z * bricks.y + brick.y) * bricks.x + brick.x);
}

bool isInBox(ivec3 inBox) {
    return all(greaterThanEqual(inBox, ivec3(0))) && all(lessThan(inBox, grid.boxSize.xyz));
}

// Number of a voxel among those with sums; below 0 outside of the box and of its marked bricks.
int sumPlace(ivec3 voxel) {
    ivec3 inBox = voxel - grid.boxMin.xyz;
    if (!isInBox(inBox)) return -1;
    ivec3 inBrick = inBox % THESIS_BRICK;
    return (int(brickSlots[brickIndex(inBox / THESIS_BRICK)]) - 1) * THESIS_BRICK_VOXELS +
           (inBrick.z * THESIS_BRICK + inBrick.y) * THESIS_BRICK + inBrick.x;
}
