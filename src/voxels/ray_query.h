// SPDX-License-Identifier: MIT
// Twin of shaders/lib/ray_query.glsl on the CPU: the same packed records, the same face test, but in double
// precision and voxel by voxel (Amanatides and Woo 1987, "A Fast Voxel Traversal Algorithm for Ray Tracing"),
// without bricks, octants or reach. For tests, and for tools that need one ray, not millions.
//
// Grid coordinates, in voxels.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "shared/voxels.h"
#include "voxels/surface_voxels.h"
#include "voxels/voxel_grid.h"

namespace conelight::voxels {

// What SurfaceVoxels left on the GPU.
struct VoxelTables {
    VoxelGrid grid;
    std::vector<std::uint32_t> brickWords;  // four per brick
    std::vector<std::uint32_t> records;
    std::vector<gpu::FaceRecord> faces;

    bool has(const glm::ivec3& voxel) const;
    // The record of an occupied voxel.
    std::uint32_t record(const glm::ivec3& voxel) const;
};

VoxelTables downloadVoxels(const SurfaceVoxels& surface);  // waits for the GPU

struct VoxelHit {
    int face = -1;  // -1: nothing was met
    double t = 0;   // in voxels; tMax when nothing was met
};

// `direction` is a unit vector. `leaves`: normal of the surface that the ray starts from, or 0.
VoxelHit traceVoxels(const VoxelTables& voxels, const glm::dvec3& origin, const glm::dvec3& direction,
                     double tMax, const glm::dvec3& leaves = glm::dvec3(0));

}  // namespace conelight::voxels
