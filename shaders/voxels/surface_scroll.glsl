// SPDX-License-Identifier: MIT
// Updates of nested grids that move: which voxels stay (docs/theory/2_voxels.md, "Nested grids"). Levels move by whole
// bricks. What a level holds before and after keeps its fragments and faces under other coordinates.
#include "lib/voxel_grid.glsl"
#if NESTED_GRIDS
layout(std140) uniform VoxelScrollBlock { VoxelScroll scroll; };

// Coordinates in a level before the update.
ivec3 voxelBefore(ivec3 voxel, int level) { return voxel - scroll.shifts[level].xyz; }

bool isInLevel(ivec3 voxel) { return isWithin(voxel, ivec3(0), gridSize()); }

// Whether a voxel of a level was its before the update.
bool wasHeld(ivec3 voxel, int level) {
    ivec3 before = voxelBefore(voxel, level);
    ivec3 finer = scroll.finer[level].xyz;
    return isInLevel(before) && !(level > 0 && isWithin(before, finer, finer + gridSize() / 2));
}

// Whether a voxel in coordinates before the update is the level's after it.
bool staysHeld(ivec3 before, int level) {
    ivec3 voxel = before + scroll.shifts[level].xyz;
    ivec3 lowest, end;
    finerVoxels(level, lowest, end);
    return isInLevel(voxel) && !isWithin(voxel, lowest, end);
}

// Whether some voxel of a box may not have been the level's before.
bool mayEnter(ivec3 low, ivec3 high, int level) {
    ivec3 lowest, end;
    finerVoxels(level, lowest, end);
    bool finerStill = level > 0 && isWithin(low, lowest, end) && isWithin(high - 1, lowest, end);
    ivec3 oldLow = voxelBefore(low, level);
    ivec3 oldHigh = voxelBefore(high, level);
    ivec3 finer = scroll.finer[level].xyz;
    bool wasFiner =
        level > 0 && all(lessThan(oldLow, finer + gridSize() / 2)) && all(greaterThan(oldHigh, finer));
    return !finerStill && (wasFiner || !isInLevel(oldLow) || !isInLevel(oldHigh - 1));
}
#endif
