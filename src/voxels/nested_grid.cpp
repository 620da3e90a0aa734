// SPDX-License-Identifier: MIT
#include "voxels/nested_grid.h"

#include <algorithm>
#include <cmath>

namespace conelight::voxels {
namespace {

// Two bricks: half of a level's voxels is a whole number of the next coarser one's bricks.
constexpr int kSizeStep = 8;
// Levels move by this part of their edge.
constexpr int kCellsPerEdge = 8;
// What a level holds beyond the scene's bounds where it need not, in voxels of the next coarser level.
constexpr double kMargin = 1.0;
// Corners that are nearer than so many voxels of level 0 are one, in spite of rounding.
constexpr float kSameCorner = 0.05f;

int roundedUp(int count, int step) { return (count + step - 1) / step * step; }

std::size_t at(int level) { return static_cast<std::size_t>(level); }

// Voxels per axis of each level: as the finest one would need for the whole scene, at most as many as the
// longest axis of the one grid has.
glm::ivec3 levelSize(const VoxelGrid& whole, int levels) {
    const int most = roundedUp(std::max({whole.size.x, whole.size.y, whole.size.z}), kSizeStep);
    glm::ivec3 size;
    for (int axis = 0; axis < 3; ++axis)
        size[axis] = std::min(roundedUp(whole.size[axis], kSizeStep) << (levels - 1), most);
    return size;
}

// Steps of a level, in bricks of the next coarser one.
int stepOf(int size) { return std::max(size / 8 / kCellsPerEdge, 1); }

// The middle of the cell of level 0 that holds a point: all levels change when that does, and then alone.
double cellMiddle(double around, double low, double voxel, int size) {
    const double cell = 8 * voxel * stepOf(size);
    return std::isfinite(around) ? low + (std::floor((around - low) / cell) + 0.5) * cell : low;
}

// Where a level begins in the next coarser one, in bricks of that.
int placeIn(double parentLow, double parentVoxel, int size, double lowest, double highest, double around) {
    const double edge = 0.5 * size * parentVoxel;
    const double margin = kMargin * parentVoxel;
    const double least = lowest - margin, most = highest + margin - edge;
    const double low = least < most ? std::clamp(around - 0.5 * edge, least, most) : 0.5 * (least + most);
    const int step = stepOf(size);
    const double cells = std::round((low - parentLow) / (4 * parentVoxel * step));
    return static_cast<int>(std::clamp(cells * step, 0.0, size / 8.0));
}

}  // namespace

int levelsFor(const VoxelGrid& whole) {
    int levels = 1;
    while (levels < VOXEL_MOST_LEVELS && std::ldexp(whole.voxelSize, 1 - levels) > kSmallVoxel) ++levels;
    return levels;
}

VoxelGrid nestedGrid(const VoxelGrid& whole, const Aabb& bounds, int levels, const glm::vec3& around) {
    int count = std::clamp(levels > 0 ? levels : levelsFor(whole), 1, VOXEL_MOST_LEVELS);
    while (count > 1 && count * levelSize(whole, count).z > VOXEL_MOST_STORED) --count;
    if (count == 1 || bounds.empty()) return whole;
    VoxelGrid grid;
    grid.levels = count;
    grid.size = levelSize(whole, count);
    grid.voxelSize = std::ldexp(whole.voxelSize, 1 - count);

    // From the coarsest level inwards: places in bricks, world positions in double precision.
    glm::dvec3 low(whole.origin);
    low -= glm::dvec3((grid.size - whole.size) / 8) * 4.0 * static_cast<double>(whole.voxelSize);
    glm::dvec3 eye;
    for (int axis = 0; axis < 3; ++axis)
        eye[axis] = cellMiddle(static_cast<double>(around[axis]), low[axis],
                               static_cast<double>(grid.voxelSize), grid.size[axis]);
    std::array<glm::ivec3, VOXEL_MOST_LEVELS> places{};
    for (int level = count - 2; level >= 0; --level) {
        const double parentVoxel = std::ldexp(static_cast<double>(grid.voxelSize), level + 1);
        for (int axis = 0; axis < 3; ++axis) {
            const int place =
                placeIn(low[axis], parentVoxel, grid.size[axis], static_cast<double>(bounds.min[axis]),
                        static_cast<double>(bounds.max[axis]), eye[axis]);
            places[at(level)][axis] = place;
            low[axis] += 4 * parentVoxel * place;
        }
    }
    grid.origin = glm::vec3(low);
    // Outwards again, in voxels of level 0: a brick of a level's parent has eight of the level's own.
    for (int level = 0; level + 1 < count; ++level)
        grid.corners[at(level + 1)] = grid.corners[at(level)] - (places[at(level)] << (level + 3));
    return grid;
}

int levelAt(const VoxelGrid& grid, const glm::vec3& point) {
    for (int level = 0; level + 1 < grid.levels; ++level) {
        const glm::vec3 low(grid.corners[at(level)]);
        const glm::vec3 high = low + std::ldexp(1.0f, level) * glm::vec3(grid.size);
        if (glm::all(glm::greaterThanEqual(point, low)) && glm::all(glm::lessThan(point, high))) return level;
    }
    return grid.levels - 1;
}

bool isWithinFiner(const VoxelGrid& grid, int level, const glm::ivec3& voxel) {
    if (level == 0) return false;
    const glm::ivec3 low = (grid.corners[at(level - 1)] - grid.corners[at(level)]) >> level;
    const glm::ivec3 within = voxel - low;
    return within.x >= 0 && within.y >= 0 && within.z >= 0 && within.x < grid.size.x / 2 &&
           within.y < grid.size.y / 2 && within.z < grid.size.z / 2;
}

glm::ivec3 storedVoxel(const VoxelGrid& grid, int level, const glm::ivec3& voxel) {
    return voxel + glm::ivec3(0, 0, level * grid.size.z);
}

int levelOfStored(const VoxelGrid& grid, const glm::ivec3& stored) { return stored.z / grid.size.z; }

bool isMoved(const VoxelGrid& from, const VoxelGrid& to) {
    if (from.levels < 2 || from.levels != to.levels || from.size != to.size || from.voxelSize != to.voxelSize)
        return false;
    const glm::vec3 apart = glm::abs(from.coarsest().origin - to.coarsest().origin);
    return std::max({apart.x, apart.y, apart.z}) < kSameCorner * from.voxelSize;
}

// The coarsest level stays.
glm::ivec3 shiftOf(const VoxelGrid& from, const VoxelGrid& to, int level) {
    const glm::ivec3 before = from.corners[at(level)] - from.corners[at(from.levels - 1)];
    const glm::ivec3 after = to.corners[at(level)] - to.corners[at(to.levels - 1)];
    return (before - after) >> level;
}

gpu::VoxelScroll scrollOf(const VoxelGrid& from, const VoxelGrid& to) {
    gpu::VoxelScroll scroll{};
    for (int level = 0; level < from.levels; ++level) {
        scroll.shifts[level] = glm::ivec4(shiftOf(from, to, level), 0);
        if (level > 0)
            scroll.finer[level] =
                glm::ivec4((from.corners[at(level - 1)] - from.corners[at(level)]) >> level, 0);
    }
    return scroll;
}

}  // namespace conelight::voxels
