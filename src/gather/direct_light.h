// SPDX-License-Identifier: MIT
// Light that reaches the eye without a bounce: surfaces + lights -> two RGBA32F textures. Readers need a
// texture-fetch barrier. GL state changed: program and its slots.
#pragma once

#include <vector>

#include "base/steps.h"
#include "gather/cone_shadows.h"
#include "gl/device.h"
#include "gl/texture.h"
#include "light/lights.h"
#include "scene/gpu_scene.h"
#include "view/surfaces.h"

namespace conelight::gather {

// What shading by lights alone reads.
struct DirectInputs {
    const scene::GpuScene& scene;
    const light::Lights& lights;
    const view::Surfaces& surfaces;

    void declare(gl::Inputs& inputs) const { inputs.add(scene).add(lights).add(surfaces); }
};

class DirectLight {
  public:
    // `cones`: shadows by them; null: by shadow maps.
    void draw(const gl::Device& device, const DirectInputs& inputs, const ConeShadows* cones = nullptr) {
        drawInSteps(device, inputs, cones).finish();
    }
    base::Steps drawInSteps(const gl::Device& device, const DirectInputs& inputs, const ConeShadows* cones);

    const gl::Texture& diffuse() const {
        return diffuse_;
    }  // reflected, plus emission; sky radiance; a: seen
    const gl::Texture& specular() const { return specular_; }  // reflected; a: seen

    static std::vector<gl::ProgramDesc> programDescs();
    // With shadows by cones; `defines` are all that ConeShadows may have.
    static std::vector<gl::ProgramDesc> coneDescs(const std::vector<gl::Defines>& defines);

  private:
    gl::Texture diffuse_, specular_;
};

}  // namespace conelight::gather
