// SPDX-License-Identifier: MIT
// Voxel faces as light left them: a gpu::LitFace (shared/irradiance.h) per face of the voxels, in their
// order. Part of the values that hold light: light::LitVoxels, gather::ConeVolume.
#pragma once

#include <cstdint>

#include "gl/buffer.h"
#include "gl/inputs.h"
#include "gl/texture.h"

namespace conelight::light {

class LitFaces {
  public:
    // Makes room for so many faces. What is there may be lost.
    void reserve(std::uint32_t faces);

    void declare(gl::Inputs& inputs) const;  // litFaces, LitFaceTable
    const gl::Buffer& buffer() const { return faces_; }

  private:
    gl::Buffer faces_;
    gl::Texture texels_;
};

}  // namespace conelight::light
