// SPDX-License-Identifier: MIT
// What rays need to cross empty space: SurfaceVoxels -> octWord of shared/voxels.h, per brick and octant of
// directions the voxels that face the octant and the reach of the empty space ahead. Read by
// lib/ray_query.glsl.
//
// Built anew whenever the voxels are. Memory: 64 bytes per brick of the grid (2.1 MB at 128^3).
#pragma once

#include <vector>

#include "gl/device.h"
#include "gl/texture.h"
#include "voxels/surface_voxels.h"

namespace conelight::voxels {

class OctantWords {
  public:
    // Ends with the barrier for texture fetches and image loads.
    void build(const gl::Device& device, const SurfaceVoxels& surface) {
        buildInSteps(device, surface).finish();
    }
    base::Steps buildInSteps(const gl::Device& device, const SurfaceVoxels& surface);

    // What shaders may read: voxelOctants.
    void declare(gl::Inputs& inputs) const;

    const gl::Texture& texture() const { return texture_; }

    static std::vector<gl::ProgramDesc> programDescs();

  private:
    void reserve(const glm::ivec3& bricks);

    gl::Texture texture_;
    gl::Buffer rows_;
    gl::Texture rowTexels_;
};

}  // namespace conelight::voxels
