// SPDX-License-Identifier: MIT
// Nested grids: one grid for a scene -> levels around a point, each with twice the voxel of the one before and as
// many of them (docs/theory/2_voxels.md, "Nested grids"). GLSL twin of the addresses: shaders/lib/voxel_levels.glsl.
//
// The coarsest level has the voxels of the one grid, where that would have them. Each finer level is a box of half its
// edge, on borders of bricks of the next coarser one. What a point's finest level holds, no other one does.
#pragma once

#include "voxels/voxel_grid.h"

namespace conelight::voxels {

// `levels` of them, 1..VOXEL_MOST_LEVELS, as far as they have room (VOXEL_MOST_STORED); 1: `whole` itself; 0: levelsFor(whole).
// `bounds` are the scene's, which the levels stay in as far as they can. The same levels for all points of a lattice cell of
// an eighth of level 0, roughly, so that a point that moves changes them seldom.
VoxelGrid nestedGrid(const VoxelGrid& whole, const Aabb& bounds, int levels, const glm::vec3& around);

// How many levels bring the voxels at the eye down to kSmallVoxel or below, 1 where those of the one grid are: what rooms
// take at 64 voxels. Scenes are in m; for one that is not, a number of levels is to be given.
inline constexpr float kSmallVoxel = 0.15f;
int levelsFor(const VoxelGrid& whole);

// The finest level that holds a point in grid coordinates; the coarsest where none does.
int levelAt(const VoxelGrid& grid, const glm::vec3& point);

// Whether a voxel of a level (its own coordinates) lies in the next finer one, and so holds nothing.
bool isWithinFiner(const VoxelGrid& grid, int level, const glm::ivec3& voxel);

// A voxel of a level as it is stored, and back.
glm::ivec3 storedVoxel(const VoxelGrid& grid, int level, const glm::ivec3& voxel);
int levelOfStored(const VoxelGrid& grid, const glm::ivec3& stored);

// Whether two are the same levels round two eyes: the finer ones lie elsewhere, by whole bricks.
bool isMoved(const VoxelGrid& from, const VoxelGrid& to);
// What coordinates in a level gain then, in its voxels.
glm::ivec3 shiftOf(const VoxelGrid& from, const VoxelGrid& to, int level);
gpu::VoxelScroll scrollOf(const VoxelGrid& from, const VoxelGrid& to);

}  // namespace conelight::voxels
