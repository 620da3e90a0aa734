// SPDX-License-Identifier: MIT
// Mean of views, as a value: the picture of an anti-aliased still as it grows, view by view. Linear radiance
// and coverage; emission, direct light and the background count as what was gathered does.
//
// Ends with the barriers for texture fetches and framebuffers. GL state changed: program and its slots.
#pragma once

#include <vector>

#include "base/steps.h"
#include "gl/buffer.h"
#include "gl/device.h"
#include "gl/texture.h"

namespace conelight::image {

class ViewMean {
  public:
    // RGBA32F of this size, to draw the next view to: its content is lost with the next.
    const gl::Texture& view(int width, int height);
    // The view just drawn, number `number` from 0, into `mean`: RGBA32F, of the same size.
    base::Steps add(const gl::Device& device, int number, const gl::Texture& mean);

    static std::vector<gl::ProgramDesc> programDescs();

  private:
    gl::Texture view_;
    gl::Buffer constants_;
};

}  // namespace conelight::image
