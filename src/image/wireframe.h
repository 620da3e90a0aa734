// SPDX-License-Identifier: MIT
// Edges of the scene's triangles: GpuScene -> lines on a picture. Over: on top of it, hidden ones left out by
// the G-buffer's depth. Alone: all of them, on the sky.
//
// Reads: frame block, scene tables. Writes `output` (RGBA32F, as a framebuffer). GL state changed: raster
// state, program, BINDING_PASS.
#pragma once

#include "conelight/settings.h"
#include "gl/pass.h"
#include "gl/program.h"
#include "scene/gpu_scene.h"
#include "view/gbuffer.h"

namespace conelight::image {

class WireframeView {
  public:
    // `exposure` of the picture, stops: lines have the same brightness on the screen whatever it is. `culls`:
    // as the G-buffer was drawn.
    void draw(gl::ProgramLibrary& programs, gl::Profiler& profiler, const scene::GpuScene& scene,
              const view::GBuffer& gbuffer, Wireframe kind, float exposure, const glm::vec3& sky, bool culls,
              const gl::Texture& output);

    static std::vector<gl::ProgramDesc> programDescs();

  private:
    gl::Buffer constants_;
};

}  // namespace conelight::image
