// SPDX-License-Identifier: MIT
// The fit of the grid, addresses, and the packed numbers of records.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "conelight/error.h"
#include "voxels/voxel_grid.h"
#include "voxels/voxel_record.h"

namespace conelight::voxels {
namespace {

double distanceToBorder(double x) { return std::abs(x - std::round(x)); }

Aabb randomBox(std::mt19937& random) {
    std::uniform_real_distribution<float> place(-50, 50);
    std::uniform_real_distribution<float> logSize(-2, 2);
    Aabb box;
    box.min = {place(random), place(random), place(random)};
    for (int axis = 0; axis < 3; ++axis) box.max[axis] = box.min[axis] + std::pow(10.0f, logSize(random));
    return box;
}

// Moving things: the lattice stays, only whole bricks come and go.
TEST(VoxelGrid, GrowsByWholeBricksToWhatHasLeftIt) {
    std::mt19937 random(2);
    std::uniform_real_distribution<float> place(-1.5f, 1.5f);
    for (int i = 0; i < 1000; ++i) {
        const Aabb box = randomBox(random);
        const VoxelGrid grid = fitGrid(box, 8 + 4 * (i % 100), 0.02f);
        EXPECT_EQ(grownGrid(grid, box), grid);
        Aabb moved = box;
        const glm::vec3 far = box.center() + glm::vec3(place(random), place(random), place(random)) *
                                                 glm::vec3(grid.size) * grid.voxelSize;
        moved.grow(far);
        const VoxelGrid grown = grownGrid(grid, moved);
        EXPECT_EQ(grown.voxelSize, grid.voxelSize);
        for (int axis = 0; axis < 3; ++axis) {
            const int limit = std::max(grid.size[axis], std::min(2 * grid.size[axis], 512));
            EXPECT_EQ(grown.size[axis] % 4, 0);
            EXPECT_LE(grown.size[axis], limit);
            const double bricks =
                static_cast<double>(grid.origin[axis] - grown.origin[axis]) / (4 * grid.voxelSize);
            EXPECT_GE(bricks, -1e-3);
            EXPECT_LT(distanceToBorder(bricks), 1e-3 + 1e-5 * std::abs(far[axis] / grid.voxelSize));
            // All of it is inside, unless the limit forbids.
            const float slack = 1e-3f * grid.voxelSize + 1e-5f * std::abs(far[axis]);
            if (grown.size[axis] < limit) {
                EXPECT_LE(grown.origin[axis], moved.min[axis] + slack);
                EXPECT_GE(grown.worldFromGrid(glm::vec3(grown.size))[axis], moved.max[axis] - slack);
            }
        }
    }
}

TEST(VoxelGrid, HoldsTheSceneWithItsPaddingAndHasTheSizeAskedFor) {
    std::mt19937 random(1);
    for (int i = 0; i < 2000; ++i) {
        const Aabb box = randomBox(random);
        const int size = 8 + 4 * (i % 100);
        const float padding = 0.01f * static_cast<float>(i % 30);
        const VoxelGrid grid = fitGrid(box, size, padding);
        EXPECT_EQ(glm::max(grid.size.x, glm::max(grid.size.y, grid.size.z)), size);
        const glm::vec3 extent = box.extent();
        const float longest = glm::max(extent.x, glm::max(extent.y, extent.z));
        const glm::vec3 far = grid.worldFromGrid(glm::vec3(grid.size));
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_EQ(grid.size[axis] % 4, 0);
            // A thousandth of a voxel for the rounding of origin and voxel size.
            const float slack = 1e-3f * grid.voxelSize + 1e-5f;
            EXPECT_GE(box.min[axis] - grid.origin[axis], padding * longest - slack);
            EXPECT_GE(far[axis] - box.max[axis], padding * longest - slack);
            // No axis has a whole brick more than it needs.
            EXPECT_LT(static_cast<float>(grid.size[axis]) * grid.voxelSize,
                      extent[axis] + 2 * padding * longest + 6 * grid.voxelSize);
        }
    }
}

TEST(VoxelGrid, BoundsAndMiddlePlanesStayAwayFromVoxelBorders) {
    std::mt19937 random(2);
    for (int i = 0; i < 2000; ++i) {
        Aabb box = randomBox(random);
        box.max -= box.min;  // near the origin, so that float coordinates do not blur the fractions
        box.min = glm::vec3(0);
        const VoxelGrid grid = fitGrid(box, 8 + 4 * (i % 100), 0.01f * static_cast<float>(i % 10));
        for (int axis = 0; axis < 3; ++axis) {
            const auto at = [&](double x) {
                return (x - static_cast<double>(grid.origin[axis])) / static_cast<double>(grid.voxelSize);
            };
            EXPECT_GT(distanceToBorder(at(0)), 0.125);
            EXPECT_GT(distanceToBorder(at(static_cast<double>(box.max[axis]))), 0.125);
            EXPECT_GT(distanceToBorder(at(0.5 * static_cast<double>(box.max[axis]))), 0.1);
        }
    }
}

TEST(VoxelGrid, FlatPointLikeAndEmptyBoundsGiveAUsableGrid) {
    Aabb flat;
    flat.grow(glm::vec3(-1, 2, -1));
    flat.grow(glm::vec3(1, 2, 1));
    EXPECT_EQ(fitGrid(flat, 64, 0.0f).size, glm::ivec3(64, 4, 64));
    Aabb point;
    point.grow(glm::vec3(3, 4, 5));
    for (const Aabb& box : {point, Aabb{}}) {
        const VoxelGrid grid = fitGrid(box, 16, 0.03f);
        EXPECT_EQ(grid.size, glm::ivec3(16));
        EXPECT_GT(grid.voxelSize, 0.0f);
    }
    EXPECT_TRUE(fitGrid(point, 16, 0)
                    .contains(VoxelGrid::voxelOf(fitGrid(point, 16, 0).gridFromWorld(glm::vec3(3, 4, 5)))));
}

TEST(VoxelGrid, ShiftMovesTheLatticeAndNothingElse) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> part(0, 1);
    for (int i = 0; i < 2000; ++i) {
        const Aabb box = randomBox(random);
        const int size = 8 + 4 * (i % 100);
        const float padding = 0.01f * static_cast<float>(i % 10);
        const glm::vec3 shift(part(random), part(random), i % 5 == 0 ? 1.0f : part(random));
        const VoxelGrid still = fitGrid(box, size, padding);
        const VoxelGrid moved = fitGrid(box, size, padding, shift);
        EXPECT_EQ(moved.voxelSize, still.voxelSize);
        const glm::vec3 far = moved.worldFromGrid(glm::vec3(moved.size));
        for (int axis = 0; axis < 3; ++axis) {
            const float slack = 1e-3f * still.voxelSize + 1e-5f;
            EXPECT_NEAR(still.origin[axis] - moved.origin[axis], shift[axis] * still.voxelSize, slack);
            EXPECT_LE(moved.origin[axis], box.min[axis] + slack);
            EXPECT_GE(far[axis], box.max[axis] - slack);
            EXPECT_LE(moved.size[axis], still.size[axis] + 4);
        }
    }
}

TEST(VoxelGrid, SizesOutOfRangeAreRefused) {
    for (const int size : {0, 4, 7, 66, 516, -8}) EXPECT_THROW(fitGrid(Aabb{}, size, 0), Error) << size;
}

TEST(VoxelGrid, PointsOnABorderBelongToTheNextVoxel) {
    EXPECT_EQ(VoxelGrid::voxelOf(glm::vec3(5.0f, 4.999f, 5.001f)), glm::ivec3(5, 4, 5));
    EXPECT_EQ(VoxelGrid::voxelOf(glm::vec3(0.0f, -0.001f, 7.5f)), glm::ivec3(0, -1, 7));
}

TEST(VoxelGrid, AddressesComeBack) {
    for (int z = 0; z < 12; ++z)
        for (int y = 0; y < 8; ++y)
            for (int x = 0; x < 16; ++x) {
                const glm::ivec3 voxel(x, y, z);
                EXPECT_EQ(voxelOfBit(voxel / 4, bitOfVoxel(voxel)), voxel);
                EXPECT_EQ(unpackVoxel(packVoxel(voxel * 60)), voxel * 60);
                EXPECT_LT(brickIndex(voxel / 4, {4, 2, 3}), 24u);
            }
}

TEST(VoxelRecord, PackedNumbersComeBackWithinTheirStep) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> unit(0, 1);
    for (int i = 0; i < 20000; ++i) {
        const float offset = 2 * unit(random) - 1;
        const float weight = 4 * unit(random);
        const std::uint32_t ow = packOffsetWeight(offset, weight);
        EXPECT_NEAR(unpackOffset(ow), offset, 0.51f / 32767);
        EXPECT_NEAR(unpackWeight(ow), weight, 2.01f / 65535);
        const glm::vec3 a(unit(random), unit(random), unit(random));
        const glm::vec3 b(unit(random), unit(random), unit(random));
        glm::vec3 low, high;
        unpackBounds(packBounds(glm::min(a, b), glm::max(a, b)), low, high);
        for (int k = 0; k < 3; ++k) {
            EXPECT_LE(low[k], glm::min(a[k], b[k]) + 1e-6f);
            EXPECT_GT(low[k], glm::min(a[k], b[k]) - 1.001f / 31);
            EXPECT_GE(high[k], glm::max(a[k], b[k]) - 1e-6f);
            EXPECT_LT(high[k], glm::max(a[k], b[k]) + 1.001f / 31);
        }
        const glm::vec3 albedo = unpackAlbedo(packAlbedo(a));
        EXPECT_NEAR(albedo.r, a.r, 0.51f / 2047);
        EXPECT_NEAR(albedo.b, a.b, 0.51f / 1023);
        // Shared exponent: half a step of the largest channel's mantissa, 1/512 of it at most.
        const glm::vec3 light = a * std::pow(10.0f, 8 * unit(random) - 4);
        const glm::vec3 shared = unpackRgb9e5(packRgb9e5(light));
        const float largest = glm::max(light.x, glm::max(light.y, light.z));
        for (int k = 0; k < 3; ++k) EXPECT_NEAR(shared[k], light[k], largest / 511 + 6e-8f);
        const gpu::FaceMaterial material = packFaceMaterial(a, light, weight);
        EXPECT_EQ(material.albedo, packAlbedo(a));
        for (int k = 0; k < 3; ++k)
            EXPECT_NEAR(unpackEmission(material)[k], light[k], light[k] / 2047 + 6e-8f);
        EXPECT_NEAR(unpackArea(material), weight, 2.01f / 65535);
    }
}

TEST(VoxelRecord, ExtremesAreClampedNotWrapped) {
    EXPECT_EQ(unpackWeight(packOffsetWeight(0, 1000)), 4.0f);
    EXPECT_EQ(unpackOffset(packOffsetWeight(-7, 0)), -1.0f);
    EXPECT_EQ(unpackAlbedo(packAlbedo(glm::vec3(2, -1, 1))), glm::vec3(1, 0, 1));
    EXPECT_EQ(unpackRgb9e5(packRgb9e5(glm::vec3(1e9f, -3, 0))), glm::vec3(65408, 0, 0));
    EXPECT_EQ(unpackRgb9e5(packRgb9e5(glm::vec3(0))), glm::vec3(0));
    // Rounds up to the next power of two: the exponent must follow.
    EXPECT_EQ(unpackRgb9e5(packRgb9e5(glm::vec3(1.9999f, 0, 0))), glm::vec3(2, 0, 0));
    EXPECT_EQ(unpackEmission(packFaceMaterial({}, glm::vec3(1e6f), 0)).x, 65504.0f);
}

}  // namespace
}  // namespace conelight::voxels
