// SPDX-License-Identifier: MIT
// Light that reaches the eye without a bounce: G-buffer, light table and shadow maps -> two RGBA32F textures.
//
// Reads: G-buffer, frame block, scene tables, shadow maps (all bound). Writes: `diffuse` and `specular`;
// readers need a texture-fetch barrier.
#pragma once

#include "conelight/settings.h"
#include "gl/pass.h"
#include "gl/program.h"
#include "gl/texture.h"
#include "scene/gpu_scene.h"

namespace conelight::gather {

class DirectLight {
  public:
    void draw(gl::ProgramLibrary& programs, gl::Profiler& profiler, const scene::GpuScene& scene,
              const LightSettings& settings, int width, int height);

    const gl::Texture& diffuse() const {
        return diffuse_;
    }  // diffuse reflection plus emission; sky radiance; a: seen
    const gl::Texture& specular() const { return specular_; }  // specular reflection; a: seen

    static std::vector<gl::ProgramDesc> programDescs();

  private:
    gl::Texture diffuse_, specular_;
};

}  // namespace conelight::gather
