// SPDX-License-Identifier: MIT
#include "voxels/voxel_grid.h"

#include <algorithm>
#include <cmath>

#include "base/assert.h"
#include "base/log.h"

namespace conelight::voxels {
namespace {

constexpr int kMinSize = 8;
constexpr int kMaxSize = 512;

// Added to the best symmetric placement, in voxels. Without it the plane halfway between the bounds would lie
// exactly on a border or in a voxel's middle; irrational, and different per axis, so that no plane at a
// simple fraction of the extent does. All are in (0.1, 0.122): (sqrt 5 - 2)/2, (sqrt 2 - 1)/4, (sqrt 3 -
// 1)/6.
constexpr double kShift[3] = {0.1180339887498949, 0.1035533905932738, 0.1220084679281462};

// Slack for the rounding of the voxel size to float when whole voxels are counted, in voxels.
constexpr double kRounding = 1e-3;

// Bounds that a fitted grid touches stay in it in spite of rounding, in bricks.
constexpr double kBorder = 1e-4;

double fraction(double x) { return x - std::floor(x); }

// Grid coordinate of the lower of two planes `length` voxels apart that is at least `margin` voxels above
// zero, so that both lie as far from borders as they can: borders sit in the middle of the longer of the two
// arcs into which the planes' fractions divide [0,1). Each is then at least 1/4 voxel away, less kShift.
double placeLower(double length, double margin, double shift) {
    const double f = fraction(length);
    // Lower plane at fraction a, upper at a + f. For f < 1/2 the arc outside [a, a+f] is the longer one.
    const double a = f < 0.5 ? (1.0 - f) / 2.0 : 1.0 - f / 2.0;
    double lower = std::floor(margin) + a + shift;
    if (lower < margin) lower += 1.0;
    if (lower - 1.0 >= margin) lower -= 1.0;
    return lower;
}

}  // namespace

std::size_t VoxelGrid::brickCount() const {
    const glm::ivec3 b = storedBricks();
    return static_cast<std::size_t>(b.x) * static_cast<std::size_t>(b.y) * static_cast<std::size_t>(b.z);
}

VoxelGrid VoxelGrid::level(int number) const {
    VoxelGrid one;
    one.origin = worldFromGrid(glm::vec3(corners[static_cast<std::size_t>(number)]));
    one.voxelSize = std::ldexp(voxelSize, number);
    one.size = size;
    return one;
}

bool VoxelGrid::contains(const glm::ivec3& v) const {
    return v.x >= 0 && v.y >= 0 && v.z >= 0 && v.x < size.x && v.y < size.y && v.z < size.z;
}

gpu::VoxelGrid VoxelGrid::packed() const {
    gpu::VoxelGrid g{};
    g.origin = origin;
    g.voxelSize = voxelSize;
    g.sizeX = static_cast<std::uint32_t>(size.x);
    g.sizeY = static_cast<std::uint32_t>(size.y);
    g.sizeZ = static_cast<std::uint32_t>(size.z);
    g.bricksX = g.sizeX / 4;
    g.bricksY = g.sizeY / 4;
    g.bricksZ = g.sizeZ / 4;
    g.inverseVoxelSize = 1.0f / voxelSize;
    return g;
}

gpu::VoxelLevels VoxelGrid::packedLevels() const {
    gpu::VoxelLevels l{};
    l.count = static_cast<std::uint32_t>(levels);
    l.sizeX = static_cast<std::uint32_t>(size.x);
    l.sizeY = static_cast<std::uint32_t>(size.y);
    l.sizeZ = static_cast<std::uint32_t>(size.z);
    for (int i = 0; i < VOXEL_MOST_LEVELS; ++i) {
        const int level = std::min(i, levels - 1);
        l.levels[i] = glm::vec4(glm::vec3(corners[static_cast<std::size_t>(level)]), std::ldexp(1.0f, level));
    }
    return l;
}

VoxelGrid fitGrid(const Aabb& bounds, int size, float padding, const glm::vec3& shift) {
    if (size < kMinSize || size > kMaxSize || size % 4 != 0)
        base::fail(ErrorKind::Usage, "voxels.size: %d; a multiple of 4 from %d to %d would be right", size,
                   kMinSize, kMaxSize);
    VoxelGrid grid;
    const glm::dvec3 extent(bounds.extent());
    double longest = std::max({extent.x, extent.y, extent.z});
    const bool isPoint = bounds.empty() || !(longest > 0);
    if (isPoint) longest = 1.0;
    const double pad = std::max(0.0, static_cast<double>(padding)) * longest;
    // One voxel in reserve for the placement. The voxel size is rounded to float first: all else derives from
    // it.
    grid.voxelSize = static_cast<float>((longest + 2 * pad) / (size - 1));
    const double h = grid.voxelSize;
    const glm::dvec3 lower =
        isPoint ? (bounds.empty() ? glm::dvec3(0) : glm::dvec3(bounds.min)) - 0.5 : glm::dvec3(bounds.min);
    const double margin = pad / h;
    for (int axis = 0; axis < 3; ++axis) {
        const double length = (isPoint ? 1.0 : extent[axis]) / h;
        const double start = placeLower(length, margin, kShift[axis]);
        // start < margin + 1 and length + 2 margin <= size - 1, so the far side keeps its margin too.
        const double needed = std::max(std::ceil(start + length + margin - kRounding), 1.0);
        grid.size[axis] = std::min(4 * static_cast<int>(std::ceil(needed / 4)), std::max(size, 4));
        // Bricks left over are shared between both sides.
        const int spare = (grid.size[axis] - static_cast<int>(needed)) / 2;
        const double first = start + spare + static_cast<double>(shift[axis]);
        if (first + length > grid.size[axis]) grid.size[axis] += 4;
        grid.origin[axis] = static_cast<float>(lower[axis] - first * h);
    }
    return grid;
}

VoxelGrid grownGrid(const VoxelGrid& grid, const Aabb& bounds) {
    VoxelGrid grown = grid;
    if (bounds.empty()) return grown;
    const double edge = 4.0 * static_cast<double>(grid.voxelSize);
    for (int axis = 0; axis < 3; ++axis) {
        const int bricks = grid.size[axis] / 4;
        const int room = std::max(std::min(2 * bricks, kMaxSize / 4) - bricks, 0);
        const double origin = static_cast<double>(grid.origin[axis]);
        // In bricks from the lowest corner; clamped before they become integers.
        const double low = (static_cast<double>(bounds.min[axis]) - origin) / edge;
        const double high = (static_cast<double>(bounds.max[axis]) - origin) / edge;
        const int below = static_cast<int>(std::clamp(std::ceil(-low - kBorder), 0.0, 1.0 * room));
        const int above = static_cast<int>(std::clamp(std::ceil(high - bricks - kBorder), 0.0, 1.0 * room));
        // Both sides at once may ask for more than there is room: each gets its share.
        const int under = below + above <= room ? below : room * below / (below + above);
        const int over = std::min(above, room - under);
        grown.size[axis] = 4 * (bricks + under + over);
        grown.origin[axis] = static_cast<float>(origin - under * edge);
    }
    return grown;
}

std::uint32_t brickIndex(const glm::ivec3& brick, const glm::ivec3& bricks) {
    return static_cast<std::uint32_t>(brick.x + bricks.x * (brick.y + bricks.y * brick.z));
}

std::uint32_t bitOfVoxel(const glm::ivec3& voxel) {
    return static_cast<std::uint32_t>((voxel.x & 3) | ((voxel.y & 3) << 2) | ((voxel.z & 3) << 4));
}

glm::ivec3 voxelOfBit(const glm::ivec3& brick, std::uint32_t bit) {
    const int b = static_cast<int>(bit);
    return 4 * brick + glm::ivec3(b & 3, (b >> 2) & 3, b >> 4);
}

std::uint32_t packVoxel(const glm::ivec3& voxel) {
    return static_cast<std::uint32_t>(voxel.x | (voxel.y << 10) | (voxel.z << 20));
}

glm::ivec3 unpackVoxel(std::uint32_t bits) {
    const int b = static_cast<int>(bits & 0x3fffffffu);
    return {b & 1023, (b >> 10) & 1023, b >> 20};
}

}  // namespace conelight::voxels
