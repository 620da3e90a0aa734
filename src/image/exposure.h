// SPDX-License-Identifier: MIT
// Exposure of a picture on the GPU, as a value: what ImageSettings say, or what autoExposure()
// (conelight/renderer.h) finds in the picture.
#pragma once

#include <vector>

#include "conelight/settings.h"
#include "gl/buffer.h"
#include "gl/device.h"
#include "gl/texture.h"

namespace conelight::image {

class Exposure {
  public:
    // `linear`: RGBA32F. Ends with the barrier for uniform blocks. GL state changed: program and its slots.
    void measure(const gl::Device& device, const gl::Texture& linear, const AutoFloat& wanted);

    void declare(gl::Inputs& inputs) const;  // ExposureBlock

    static std::vector<gl::ProgramDesc> programDescs();

  private:
    gl::Buffer counts_;  // pixels per bin of luminance
    gl::Buffer block_;
};

}  // namespace conelight::image
