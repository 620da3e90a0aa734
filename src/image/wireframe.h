// SPDX-License-Identifier: MIT
// Edges of the scene's triangles: GpuScene -> lines on a picture. Over: on top of it, hidden ones left out by
// the G-buffer's depth. Alone: all of them, on the sky.
//
// Reads: frame block, scene tables. Writes `output` (RGBA32F, as a framebuffer). GL state changed: raster
// state, program and its slots.
#pragma once

#include "conelight/settings.h"
#include "gl/device.h"
#include "image/exposure.h"
#include "scene/gpu_scene.h"
#include "view/surfaces.h"

namespace conelight::image {

class WireframeView {
  public:
    struct Wanted {
        Wireframe kind;
        AutoFloat exposure;  // of the picture: lines have the same brightness on the screen whatever it is
        bool culls;          // as the surfaces were drawn
    };
    void draw(const gl::Device& device, const scene::GpuScene& scene, const view::Surfaces& surfaces,
              const Wanted& wanted, const gl::Texture& output);

    static std::vector<gl::ProgramDesc> programDescs();

  private:
    Exposure exposure_;
    gl::Buffer constants_;
};

}  // namespace conelight::image
