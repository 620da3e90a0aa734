// SPDX-License-Identifier: MIT
// Where voxels lie: bounds and settings -> a grid of cubes, and the arithmetic of addresses in it.
// Cubic voxels, any number per axis divisible by 4 (bricks of 4^3), neither cubic nor a power of two.
// GLSL twin of the address functions: shaders/lib/voxel_address.glsl.
//
// Rule for borders: a voxel is half-open, lower side in, upper side out (a point at grid coordinate 5.0 is in
// voxel 5, whichever way its surface faces). The fit keeps the planes that scenes are made of away from
// borders, see fitGrid.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>

#include "conelight/scene.h"
#include "shared/voxels.h"

namespace conelight::voxels {

// One grid, or several that lie in one another (voxels/nested_grid.h): level 0 is the finest, each further one has
// twice the edge and as many voxels. Grid coordinates are those of level 0, also beyond it.
struct VoxelGrid {
    glm::vec3 origin{0.0f};  // world position of the lowest corner
    float voxelSize = 1.0f;  // edge of a voxel in m
    glm::ivec3 size{4};      // voxels per axis, multiples of 4
    int levels = 1;
    std::array<glm::ivec3, VOXEL_MOST_LEVELS> corners{};  // lowest one of each level, in voxels of level 0

    glm::ivec3 bricks() const { return size / 4; }
    // Of all levels, which are stored one behind the other along z.
    glm::ivec3 storedBricks() const { return {size.x / 4, size.y / 4, levels * (size.z / 4)}; }
    std::size_t brickCount() const;
    // One level as a grid of its own.
    VoxelGrid level(int number) const;
    VoxelGrid coarsest() const { return level(levels - 1); }
    std::size_t voxelCapacity() const { return 64 * brickCount(); }
    // World position -> grid coordinates, in voxels; inverse.
    glm::vec3 gridFromWorld(const glm::vec3& world) const { return (world - origin) * (1.0f / voxelSize); }
    glm::vec3 worldFromGrid(const glm::vec3& grid) const { return origin + grid * voxelSize; }
    // The voxel of a grid coordinate by the half-open rule; may lie outside the grid.
    static glm::ivec3 voxelOf(const glm::vec3& grid) { return glm::ivec3(glm::floor(grid)); }
    bool contains(const glm::ivec3& voxel) const;

    gpu::VoxelGrid packed() const;  // counts zero
    gpu::VoxelLevels packedLevels() const;
    bool operator==(const VoxelGrid&) const = default;
};

// The grid for `bounds`: `size` voxels along the longest axis (8..512, divisible by 4), `padding` times the
// longest extent free on each side. Throws Error(Usage) for a size out of range. Empty bounds: a unit cube.
//
// Placement. On each axis the scene's two bounding planes would fall anywhere within a voxel; they are
// shifted (by at most one voxel, which the fit holds in reserve) so that both lie at least 0.128 voxel from
// borders, and the plane halfway between them at least 0.1 voxel. Derivation: docs/theory/2_voxels.md, "The
// grid".
//
// `shift`, 0..1 voxel per axis, then moves the grid toward lower coordinates, all else equal; where the scene
// would no longer fit, which takes a padding below one voxel, an axis gets one more brick.
VoxelGrid fitGrid(const Aabb& bounds, int size, float padding, const glm::vec3& shift = glm::vec3(0));

// `grid` and as many bricks more on each side as it takes to hold `bounds`: voxels stay where they are. An
// axis grows to twice its voxels at most, and to 512 (a grid that is longer stays so); what lies farther out
// is not in the grid. The same grid and bounds give the same result, so what comes back finds the grid it
// left.
VoxelGrid grownGrid(const VoxelGrid& grid, const Aabb& bounds);

// Linear brick index, x fastest; bit of a voxel in its brick, x fastest (0..63).
std::uint32_t brickIndex(const glm::ivec3& brick, const glm::ivec3& bricks);
std::uint32_t bitOfVoxel(const glm::ivec3& voxel);
glm::ivec3 voxelOfBit(const glm::ivec3& brick, std::uint32_t bit);
// Three coordinates of 10 bits each.
std::uint32_t packVoxel(const glm::ivec3& voxel);
glm::ivec3 unpackVoxel(std::uint32_t bits);

}  // namespace conelight::voxels
