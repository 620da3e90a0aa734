// SPDX-License-Identifier: MIT
// Levels of nested grids (NESTED_GRIDS 1; otherwise the file is empty): which level a point lies in, and how a level's
// voxels are stored. C++ twin: src/voxels/nested_grid.h. Method: docs/theory/2_voxels.md, "Nested grids".
//
// Grid coordinates are those of level 0, in its voxels, also beyond it. A level has coordinates of its own, in its
// voxels from its corner. It is stored behind the one before along z: packed voxels and bricks are stored ones.
#include "lib/voxel_address.glsl"
#include "shared/voxels.h"
#ifndef NESTED_GRIDS
#define NESTED_GRIDS 0
#endif
#if NESTED_GRIDS
layout(std140) uniform VoxelLevelBlock { VoxelLevels voxelLevels; };

vec3 levelSize() { return vec3(voxelLevels.sizeX, voxelLevels.sizeY, voxelLevels.sizeZ); }
int coarsestLevel() { return int(voxelLevels.count) - 1; }

// Corner and edge of a level, in voxels of level 0.
vec4 levelPlace(int level) { return voxelLevels.levels[level]; }
vec3 levelFromGrid(vec3 point, vec4 place) { return (point - place.xyz) / place.w; }
vec3 gridFromLevel(vec3 point, vec4 place) { return place.xyz + place.w * point; }

// The finest level that holds a point in grid coordinates; the coarsest where none does.
int levelAt(vec3 point) {
    int level = coarsestLevel();
    int i = level - 1;
    while (i >= 0) {
        vec3 within = levelFromGrid(point, voxelLevels.levels[i]);
        bool holds = all(greaterThanEqual(within, vec3(0.0))) && all(lessThan(within, levelSize()));
        level = holds ? i : level;
        --i;
    }
    return level;
}

// Edge of the voxels about a point, in voxels of level 0.
float voxelEdgeAt(vec3 point) { return levelPlace(levelAt(point)).w; }

int levelOfStored(ivec3 stored) { return stored.z / int(voxelLevels.sizeZ); }
ivec3 withinLevel(ivec3 stored, int level) { return stored - ivec3(0, 0, level * int(voxelLevels.sizeZ)); }
ivec3 storedVoxel(ivec3 voxel, int level) { return voxel + ivec3(0, 0, level * int(voxelLevels.sizeZ)); }

// Lowest corner of a packed voxel in grid coordinates, and its edge in voxels of level 0.
vec4 voxelPlace(uint bits) {
    ivec3 stored = unpackVoxel(bits);
    int level = levelOfStored(stored);
    vec4 place = levelPlace(level);
    return vec4(gridFromLevel(vec3(withinLevel(stored, level)), place), place.w);
}
float voxelEdge(uint bits) { return levelPlace(levelOfStored(unpackVoxel(bits))).w; }

bool isWithin(ivec3 voxel, ivec3 lowest, ivec3 end) {
    return all(greaterThanEqual(voxel, lowest)) && all(lessThan(voxel, end));
}

// Voxels of a level that the next finer one holds, in the level's coordinates: lowest <= voxel < end.
void finerVoxels(int level, out ivec3 lowest, out ivec3 end) {
    vec4 place = levelPlace(level);
    lowest = ivec3((levelPlace(max(level - 1, 0)).xyz - place.xyz) / place.w);
    end = level > 0 ? lowest + ivec3(levelSize()) / 2 : lowest;
}
#endif
