// SPDX-License-Identifier: MIT
// Light from the eye, for looking: surfaces + its irradiance -> added to a picture. No shadow is needed, as nothing is
// hidden from the eye; nothing bounces.
//
// Ends with the barriers for texture fetches and framebuffers. GL state changed: program and its slots.
#pragma once

#include <vector>

#include "base/steps.h"
#include "gl/device.h"
#include "gl/texture.h"
#include "scene/gpu_scene.h"
#include "view/surfaces.h"

namespace conelight::image {

class Headlight {
  public:
    struct Inputs {
        const scene::GpuScene& scene;
        const view::Surfaces& surfaces;
        float irradiance = 0;  // W/m^2, on surfaces that face the eye; 0: nothing is drawn
    };
    // Into `picture` (RGBA32F, of the size of the surfaces).
    base::Steps draw(const gl::Device& device, const Inputs& inputs, const gl::Texture& picture);
    static std::vector<gl::ProgramDesc> programDescs();

  private:
    gl::Buffer block_;
};

}  // namespace conelight::image
