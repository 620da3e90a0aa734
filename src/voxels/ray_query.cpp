// SPDX-License-Identifier: MIT
#include "voxels/ray_query.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "gl/gl.h"
#include "math/octahedral.h"
#include "voxels/voxel_record.h"

namespace conelight::voxels {
namespace {

// The constants of shaders/lib/ray_query.glsl and voxel_record.glsl.
constexpr double kFacing = 1e-3;
constexpr double kNear = 0.05;
constexpr double kStart = 1e-3;
constexpr double kBoundsSlack = 0.1;
constexpr double kBoundsOverlap = 0.04;
constexpr double kBoundsShrink = 0.02;
constexpr double kTie = 0.5;
constexpr double kOtherSide = -0.1;
constexpr double kOtherNear = 0.5;

constexpr double kNever = std::numeric_limits<double>::infinity();

struct Ray {
    glm::dvec3 origin, direction;
    double tMax;
    glm::dvec3 leaves;  // normal of the surface that it starts from, or 0
};

struct Search {
    VoxelHit hit;
    double weight = 0;
};

void testFaces(const VoxelTables& voxels, const glm::ivec3& voxel, const Ray& ray, Search& s) {
    const auto& [origin, direction, tMax, leaves] = ray;
    const std::uint32_t record = voxels.record(voxel);
    std::uint32_t face = record & 0x3ffffffu;
    for (int k = 0; k < 6; ++k) {
        if ((record >> (26 + k) & 1u) == 0) continue;
        const std::uint32_t index = face++;
        // Components of zero count as positive, as in the shader.
        if ((direction[k / 2] >= 0) != (k % 2 == 1)) continue;
        const gpu::FaceRecord& r = voxels.faces[index];
        const glm::dvec3 n(math::octDecode(math::unpackSnorm2x16(r.normal)));
        const double towards = glm::dot(n, direction);
        if (towards >= -kFacing) continue;
        const glm::dvec3 toCenter = glm::dvec3(voxel) + 0.5 - origin;
        const double ahead = static_cast<double>(unpackOffset(r.offsetWeight)) + glm::dot(n, toCenter);
        const double t = ahead / towards;
        if ((r.bounds & FACE_TWO_SIDED) != 0 && glm::dot(n, leaves) < kOtherSide && ahead > -kOtherNear)
            continue;
        glm::vec3 lower, upper;
        unpackBounds(r.bounds, lower, upper);
        const glm::dvec3 at = t * direction - toCenter + 0.5;
        const glm::dvec3 shrunk = (kBoundsSlack + kBoundsShrink) * n * n - kBoundsShrink;
        const glm::dvec3 slack =
            t > kNear ? kBoundsOverlap + (kBoundsSlack - kBoundsOverlap) * n * n : shrunk;
        bool inside = t < tMax && t > kStart;
        for (int i = 0; i < 3; ++i) {
            inside = inside &&
                     at[i] >= static_cast<double>(lower[i]) - (lower[i] > 0 ? shrunk[i] : slack[i]) &&
                     at[i] <= static_cast<double>(upper[i]) + (upper[i] < 1 ? shrunk[i] : slack[i]);
        }
        if (!inside) continue;
        const auto weight = static_cast<double>(unpackWeight(r.offsetWeight));
        if (s.hit.face < 0 || t < s.hit.t - kTie || (t <= s.hit.t + kTie && weight > s.weight)) {
            s.hit.face = static_cast<int>(index);
            s.hit.t = t;
            s.weight = weight;
        }
    }
}

}  // namespace

bool VoxelTables::has(const glm::ivec3& voxel) const {
    const std::uint32_t* word = &brickWords[std::size_t{4} * brickIndex(voxel / 4, grid.bricks())];
    const std::uint32_t bit = bitOfVoxel(voxel);
    return (word[bit / 32] >> (bit % 32) & 1u) != 0;
}

std::uint32_t VoxelTables::record(const glm::ivec3& voxel) const {
    const std::uint32_t* word = &brickWords[std::size_t{4} * brickIndex(voxel / 4, grid.bricks())];
    const std::uint32_t bit = bitOfVoxel(voxel);
    const std::uint64_t mask = word[0] | std::uint64_t{word[1]} << 32;
    const auto below = static_cast<std::uint32_t>(std::popcount(mask & ((std::uint64_t{1} << bit) - 1)));
    return records[word[2] + below];
}

VoxelTables downloadVoxels(const SurfaceVoxels& surface) {
    VoxelTables t;
    t.grid = surface.grid();
    t.brickWords.resize(4 * t.grid.brickCount());
    surface.brickWords().read(0, GL_RGBA_INTEGER, GL_UNSIGNED_INT, t.brickWords.data(),
                              4 * t.brickWords.size());
    t.records = surface.records().read<std::uint32_t>(surface.voxelCount());
    t.faces = surface.faces().read<gpu::FaceRecord>(surface.faceCount());
    return t;
}

VoxelHit traceVoxels(const VoxelTables& voxels, const glm::dvec3& origin, const glm::dvec3& direction,
                     double tMax, const glm::dvec3& leaves) {
    Search search;
    search.hit.t = tMax;
    const glm::dvec3 size(voxels.grid.size);
    double enter = 0, leave = tMax;
    for (int i = 0; i < 3; ++i) {
        if (direction[i] == 0) {
            if (origin[i] < 0 || origin[i] >= size[i]) return search.hit;
            continue;
        }
        const double a = -origin[i] / direction[i], b = (size[i] - origin[i]) / direction[i];
        enter = std::max(enter, std::min(a, b));
        leave = std::min(leave, std::max(a, b));
    }
    if (enter >= leave) return search.hit;
    glm::ivec3 cell =
        glm::clamp(glm::ivec3(glm::floor(origin + enter * direction)), glm::ivec3(0), voxels.grid.size - 1);
    glm::dvec3 next(kNever), perVoxel(kNever);
    glm::ivec3 stride(0);
    for (int i = 0; i < 3; ++i) {
        if (direction[i] == 0) continue;
        stride[i] = direction[i] > 0 ? 1 : -1;
        next[i] = (cell[i] + (direction[i] > 0 ? 1 : 0) - origin[i]) / direction[i];
        perVoxel[i] = 1 / std::abs(direction[i]);
    }
    while (true) {
        if (voxels.has(cell)) {
            testFaces(voxels, cell, {origin, direction, tMax, leaves}, search);
            if (search.hit.face >= 0) return search.hit;
        }
        const int axis = next.x <= next.y && next.x <= next.z ? 0 : (next.y <= next.z ? 1 : 2);
        if (next[axis] >= leave) return search.hit;
        cell[axis] += stride[axis];
        if (!voxels.grid.contains(cell)) return search.hit;
        next[axis] += perVoxel[axis];
    }
}

}  // namespace conelight::voxels
