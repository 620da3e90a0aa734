// SPDX-License-Identifier: MIT
// Nested grids: levels lie in one another on borders of bricks, around the eye and within the scene.
#include "voxels/nested_grid.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace conelight::test {
namespace {

using voxels::fitGrid;
using voxels::nestedGrid;
using voxels::VoxelGrid;

Aabb boxOf(const glm::vec3& min, const glm::vec3& max) { return {min, max}; }

// A landscape with hills.
const Aabb kLand = boxOf({-1000, -5, -800}, {1000, 35, 800});

VoxelGrid around(const glm::vec3& eye, int size = 128, int levels = 8) {
    return nestedGrid(fitGrid(kLand, size, 0.01f), kLand, levels, eye);
}

bool isWithin(const glm::vec3& point, const VoxelGrid& grid) {
    return grid.contains(VoxelGrid::voxelOf(grid.gridFromWorld(point)));
}

}  // namespace

TEST(NestedGrid, OneLevelIsTheGridItself) {
    const VoxelGrid whole = fitGrid(kLand, 128, 0.01f);
    EXPECT_EQ(nestedGrid(whole, kLand, 1, {3, 4, 5}), whole);
    EXPECT_EQ(nestedGrid(whole, Aabb{}, 5, {3, 4, 5}), whole);
}

TEST(NestedGrid, ChoosesAsManyLevelsAsTheEyeNeeds) {
    const auto chosen = [](float edge, int size) {
        const Aabb cube = boxOf(glm::vec3(-0.5f * edge), glm::vec3(0.5f * edge));
        const VoxelGrid whole = fitGrid(cube, size, 0.01f);
        const VoxelGrid grid = nestedGrid(whole, cube, 0, {1, 1, 1});
        EXPECT_LE(grid.voxelSize, voxels::kSmallVoxel);
        EXPECT_EQ(grid, nestedGrid(whole, cube, grid.levels, {1, 1, 1}));
        // One level fewer would not do.
        if (grid.levels > 1) {
            EXPECT_GT(2 * grid.voxelSize, voxels::kSmallVoxel);
        } else {
            EXPECT_EQ(grid, whole);
        }
        return grid.levels;
    };
    EXPECT_EQ(chosen(1, 64), 1);
    EXPECT_EQ(chosen(8.4f, 64), 1);
    EXPECT_EQ(chosen(17, 128), 1);
    EXPECT_EQ(chosen(30, 128), 2);
    EXPECT_EQ(chosen(400, 64), 7);
    EXPECT_EQ(chosen(400, 128), 6);
    EXPECT_EQ(chosen(900, 128), 7);
}

TEST(NestedGrid, CoarsestLevelHasTheVoxelsOfTheOneGrid) {
    for (const int size : {32, 100, 128, 256}) {
        const VoxelGrid whole = fitGrid(kLand, size, 0.01f);
        const VoxelGrid coarsest = around({120, 2, -300}, size).coarsest();
        EXPECT_NEAR(coarsest.voxelSize, whole.voxelSize, 1e-6f * whole.voxelSize);
        for (int axis = 0; axis < 3; ++axis) {
            const float apart = (whole.origin[axis] - coarsest.origin[axis]) / (4 * whole.voxelSize);
            EXPECT_NEAR(apart, std::round(apart), 1e-4f) << size << " axis " << axis;
            EXPECT_GE(apart, -1e-4f);
            EXPECT_LE(whole.size[axis] + 4 * std::lround(apart), coarsest.size[axis]);
        }
    }
}

TEST(NestedGrid, LevelsLieInOneAnotherOnBordersOfBricks) {
    std::mt19937 random(3);
    const auto uniform = [&](float low, float high) {
        return low + (high - low) * static_cast<float>(random()) * 0x1p-32f;
    };
    for (int i = 0; i < 200; ++i) {
        const glm::vec3 eye(uniform(-1200, 1200), uniform(-20, 60), uniform(-1200, 1200));
        const VoxelGrid grid = around(eye, i % 2 == 0 ? 64 : 128);
        ASSERT_EQ(grid.levels, 8);
        EXPECT_EQ(grid.corners[0], glm::ivec3(0));
        for (int level = 0; level + 1 < grid.levels; ++level) {
            const auto at = static_cast<std::size_t>(level);
            const glm::ivec3 apart = grid.corners[at] - grid.corners[at + 1];
            const int edge = 2 << level;  // of the coarser one's voxels
            for (int axis = 0; axis < 3; ++axis) {
                EXPECT_EQ(apart[axis] % (4 * edge), 0);
                EXPECT_GE(apart[axis], 0);
                EXPECT_LE(apart[axis] + grid.size[axis] * edge / 2, grid.size[axis] * edge);
            }
        }
    }
}

TEST(NestedGrid, TheEyeIsInTheMiddleOrTheLevelEndsWhereTheSceneDoes) {
    const glm::vec3 eye(37, 2, -411);
    const VoxelGrid grid = around(eye);
    for (int level = 0; level < 6; ++level) {
        const VoxelGrid one = grid.level(level);
        const glm::vec3 middle = one.worldFromGrid(0.5f * glm::vec3(one.size));
        // In its cell of level 0, and the level on its lattice: a sixteenth of the edge each.
        const float edge = one.voxelSize * static_cast<float>(one.size.x);
        EXPECT_LE(std::abs(middle.x - eye.x), edge / 7.9f) << level;
        EXPECT_LE(std::abs(middle.z - eye.z), edge / 7.9f) << level;
        EXPECT_TRUE(isWithin(eye, one)) << level;
    }
    // Fifteen metres of air under the ground are of no use.
    const VoxelGrid finest = grid.level(0);
    EXPECT_GT(finest.origin.y, kLand.min.y - 4);
    // An eye far outside: levels at the scene's border.
    const VoxelGrid outside = around({5000, 2, 0});
    EXPECT_LE(outside.level(0).origin.x, 1000.0f);
    EXPECT_GE(around({std::numeric_limits<float>::quiet_NaN(), 0, 0}).levels, 8);
}

TEST(NestedGrid, StaysWhileTheEyeMovesALittle) {
    int changes = 0;
    VoxelGrid before = around({0, 2, 0});
    for (int i = 1; i <= 100; ++i) {
        const VoxelGrid grid = around({0.1f * static_cast<float>(i), 2, 0});
        changes += grid == before ? 0 : 1;
        before = grid;
    }
    EXPECT_GE(changes, 1);
    EXPECT_LE(changes, 5);  // cells of two metres
}

TEST(NestedGrid, LevelsAreAsManyAsHaveRoom) {
    EXPECT_EQ(around({}, 256).levels, 4);
    EXPECT_EQ(around({}, 512).levels, 2);
    EXPECT_EQ(around({}, 64, 3).levels, 3);
}

TEST(NestedGrid, APointIsInTheFinestLevelThatHoldsIt) {
    const VoxelGrid grid = around({100, 2, 100}, 64, 5);
    std::mt19937 random(9);
    for (int i = 0; i < 2000; ++i) {
        glm::vec3 world;
        for (int axis = 0; axis < 3; ++axis)
            world[axis] = kLand.min[axis] +
                          (kLand.max[axis] - kLand.min[axis]) * static_cast<float>(random()) * 0x1p-32f;
        if (i % 2 == 0) world = glm::mix(world, glm::vec3(100, 2, 100), 0.95f);
        const int level = voxels::levelAt(grid, grid.gridFromWorld(world));
        for (int other = 0; other < grid.levels; ++other) {
            const VoxelGrid one = grid.level(other);
            const glm::ivec3 voxel = VoxelGrid::voxelOf(one.gridFromWorld(world));
            if (!one.contains(voxel)) {
                EXPECT_NE(other, level);
                continue;
            }
            EXPECT_GE(other, level);
            EXPECT_EQ(voxels::isWithinFiner(grid, other, voxel), other > level);
            const glm::ivec3 stored = voxels::storedVoxel(grid, other, voxel);
            EXPECT_EQ(voxels::levelOfStored(grid, stored), other);
            EXPECT_EQ(voxels::unpackVoxel(voxels::packVoxel(stored)), stored);
        }
    }
}

}  // namespace conelight::test
