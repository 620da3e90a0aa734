// SPDX-License-Identifier: MIT
// The block of the voxel grid and the change between world and grid coordinates. C++ twin:
// src/voxels/voxel_grid.h.
#include "lib/flat_constants.glsl"
#include "lib/voxel_levels.glsl"
#include "shared/voxels.h"
#if !FLAT_CONSTANTS
layout(std140) uniform VoxelGridBlock { VoxelGrid grid; };
#endif

vec3 gridFromWorld(vec3 world) { return (world - grid.origin) * grid.inverseVoxelSize; }
vec3 worldFromGrid(vec3 p) { return grid.origin + p * grid.voxelSize; }
ivec3 gridSize() { return ivec3(grid.sizeX, grid.sizeY, grid.sizeZ); }
ivec3 gridBricks() { return ivec3(grid.bricksX, grid.bricksY, grid.bricksZ); }
#if NESTED_GRIDS
// Of all levels.
ivec3 storedBricks() { return ivec3(grid.bricksX, grid.bricksY, grid.bricksZ * voxelLevels.count); }
#else
ivec3 storedBricks() { return gridBricks(); }
#endif
uint storedBrickCount() {
    ivec3 bricks = storedBricks();
    return uint(bricks.x * bricks.y * bricks.z);
}

// Height above a surface, in voxels, at which rays start that meet triangles from there on.
const float kStartVoxels = 1e-3;
