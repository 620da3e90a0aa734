// SPDX-License-Identifier: MIT
// How much an update of the surface voxels finds at most, worked out on the CPU: lists that have room for it cannot
// overflow, so that nobody has to wait for their counts (docs/theory/2_voxels.md, "Memory").
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "scene/gpu_scene.h"
#include "voxels/voxel_grid.h"

namespace conelight::voxels {

// At most so many more than there are; tiles: in all.
struct SurfaceBounds {
    double fragments = 0, voxels = 0, faces = 0, bricks = 0, tiles = 0;
};

// The voxels of a grid of one level that a box meets: lowest one, and behind the highest; a box that is not finite meets
// all. Grown a little, since transformed corners of a box and transformed vertices are rounded differently.
struct VoxelRange {
    glm::ivec3 low{0}, end{0};
};
VoxelRange voxelsOfBox(const VoxelGrid& grid, const Aabb& box);

class UpdateBounds {
  public:
    // Of instances that are voxelized anew (x of each run); none when the mesh of one is the host's, whose vertices the
    // CPU does not see.
    std::optional<SurfaceBounds> of(const scene::GpuScene& scene, std::span<const glm::uvec2> runs,
                                    const VoxelGrid& grid);

  private:
    // Sums over the triangles of an instance's mesh, object space.
    struct MeshSums {
        base::Revision shape, entry;
        double area = 0, longestEdges = 0, triangles = 0;
    };
    const MeshSums& sumsOf(const scene::GpuScene& scene, std::uint32_t instance);

    std::vector<MeshSums> sums_;  // per instance; of those that were asked for
};

}  // namespace conelight::voxels
