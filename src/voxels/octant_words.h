// SPDX-License-Identifier: MIT
// What rays need to cross empty space: SurfaceVoxels -> octWord of shared/voxels.h, per brick and octant of
// directions the voxels that face the octant and the reach of the empty space ahead. Read by
// lib/ray_query.glsl.
//
// Built anew whenever the voxels are. Memory: 64 bytes per brick of the grid (2.1 MB at 128^3).
#pragma once

#include <vector>

#include "gl/pass.h"
#include "gl/program.h"
#include "gl/texture.h"
#include "voxels/surface_voxels.h"

namespace conelight::voxels {

class OctantWords {
  public:
    // GL state changed: program, image 0, BINDING_STORAGE_PASS, storage slot 9, texture unit 8, what
    // SurfaceVoxels::bind binds. Ends with the barrier for texture fetches and image loads.
    void build(gl::ProgramLibrary& programs, gl::Profiler& profiler, const SurfaceVoxels& surface);

    void bind() const;  // IMAGE_VOXEL_OCTANTS

    const gl::Texture& texture() const { return texture_; }

    static std::vector<gl::ProgramDesc> programDescs();

  private:
    gl::Texture texture_;
    gl::Buffer rows_;
    gl::Texture rowTexels_;
};

}  // namespace conelight::voxels
