// SPDX-License-Identifier: MIT
#include "voxels/surface_bounds.h"

#include <algorithm>
#include <cmath>

namespace conelight::voxels {
namespace {

// Boxes are grown by this many voxels: transformed corners of a box and transformed vertices are rounded
// differently (2^-24 of their distance from the origin, a few times).
constexpr float kBoxMargin = 0.1f;
constexpr float kBoxRounding = 1e-6f;
// What tests of triangles and voxels let through, and rounding, of all that follows.
constexpr double kBoundsRounding = 1.01;

double product(const glm::ivec3& v) { return static_cast<double>(v.x) * v.y * v.z; }

// The most that a matrix lengthens anything: by the rows of its square.
double stretchOf(const glm::mat4& matrix) {
    const glm::dmat3 linear(matrix);
    const glm::dmat3 square = glm::transpose(linear) * linear;
    double most = 0;
    for (int i = 0; i < 3; ++i)
        most = std::max(most, std::abs(square[i].x) + std::abs(square[i].y) + std::abs(square[i].z));
    return std::sqrt(most);
}

}  // namespace

VoxelRange voxelsOfBox(const VoxelGrid& grid, const Aabb& box) {
    if (box.empty()) return {};
    VoxelRange range{glm::ivec3(0), grid.size};
    for (int axis = 0; axis < 3; ++axis) {
        const float a = grid.gridFromWorld(box.min)[axis];
        const float b = grid.gridFromWorld(box.max)[axis];
        if (!std::isfinite(a) || !std::isfinite(b)) continue;
        const float far =
            std::max({std::abs(box.min[axis]), std::abs(box.max[axis]), std::abs(grid.origin[axis])});
        const float margin = kBoxMargin + kBoxRounding * far / grid.voxelSize;
        const float limit = static_cast<float>(grid.size[axis]);
        range.low[axis] = static_cast<int>(std::clamp(std::floor(a - margin), 0.0f, limit));
        range.end[axis] = static_cast<int>(std::clamp(std::floor(b + margin) + 1, 0.0f, limit));
    }
    range.end = glm::max(range.end, range.low);
    return range;
}

const UpdateBounds::MeshSums& UpdateBounds::sumsOf(const scene::GpuScene& scene, std::uint32_t instance) {
    if (sums_.size() <= instance) sums_.resize(instance + std::size_t{1});
    MeshSums& sums = sums_[instance];
    if (sums.shape && sums.shape == scene.shapeRevision(instance) &&
        sums.entry == scene.entryRevision(instance))
        return sums;
    sums = {scene.shapeRevision(instance), scene.entryRevision(instance), 0, 0, 0};
    const Instance& source = scene.source().instances[instance];
    const Mesh& mesh = scene.source().meshes[static_cast<std::size_t>(source.mesh)];
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const glm::dvec3 a = mesh.positions[mesh.indices[i]], b = mesh.positions[mesh.indices[i + 1]],
                         c = mesh.positions[mesh.indices[i + 2]];
        sums.area += 0.5 * glm::length(glm::cross(b - a, c - a));
        sums.longestEdges += std::max({glm::distance(a, b), glm::distance(b, c), glm::distance(c, a)});
        sums.triangles += 1;
    }
    return sums;
}

// A cube meets a triangle K where its lowest corner lies in K + [-1,0]^3, and there are no more such corners than K +
// [-1,1]^3 has volume: 2 A (|n_x| + |n_y| + |n_z|) + 4 (w_x + w_y + w_z) + 8, with the extents w. For an edge e, the
// longest, the sums are at most sqrt(3) and sqrt(3) e.
std::optional<SurfaceBounds> UpdateBounds::of(const scene::GpuScene& scene, std::span<const glm::uvec2> runs,
                                              const VoxelGrid& grid) {
    SurfaceBounds all;
    for (const glm::uvec2& run : runs) {
        const Instance& source = scene.source().instances[run.x];
        if (scene.isHostMesh(static_cast<std::size_t>(source.mesh))) return {};
        const MeshSums& sums = sumsOf(scene, run.x);
        const double stretch = stretchOf(source.worldFromObject);
        const bool twoSided =
            (scene.materials()[scene.instances()[run.x].material].flags & MATERIAL_DOUBLE_SIDED) != 0;
        for (int level = 0; level < grid.levels; ++level) {
            const VoxelGrid one = grid.level(level);
            const VoxelRange range = voxelsOfBox(one, scene.instanceBounds(run.x));
            const double scale = stretch / static_cast<double>(one.voxelSize);
            const double area = scale * scale * sums.area, edges = scale * sums.longestEdges;
            const double voxels = product(range.end - range.low);
            const double fragments = std::min(
                kBoundsRounding * (std::sqrt(12.0) * area + std::sqrt(48.0) * edges + 8 * sums.triangles),
                sums.triangles * voxels);
            all.fragments += fragments;
            all.voxels += std::min(fragments, voxels);
            all.faces += std::min((twoSided ? 6 : 3) * fragments, 6 * voxels);
            all.bricks += product((range.end + 3) / 4 - range.low / 4);
            // Squares of 8 x 8 columns, grown by one, in the same way; those of small triangles count as well.
            all.tiles += kBoundsRounding * (area / 64 + 0.4 * edges + 5 * sums.triangles);
        }
    }
    return all;
}

}  // namespace conelight::voxels
