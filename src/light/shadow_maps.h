// SPDX-License-Identifier: MIT
// Shadow maps of all lights: GpuScene -> depth textures, and the light table's shadow fields filled in.
// Point lights: one cube; spot: one 2D layer; directional: one 2D layer fitted to the scene's bounds;
// rectangular: `area_samples` points, each with 2D layers. Compared by hardware, filtered by gather.
//
// Writes: depth textures at UNIT_SHADOW_2D (sampler2DArrayShadow) and UNIT_SHADOW_CUBE
// (samplerCubeArrayShadow), views at BINDING_SHADOW_VIEWS. Shader side: lib/shadow.glsl.
#pragma once

#include "conelight/settings.h"
#include "gl/pass.h"
#include "gl/program.h"
#include "scene/gpu_scene.h"

namespace conelight::light {

class ShadowMaps {
  public:
    ShadowMaps();
    ~ShadowMaps();

    // Draws every map anew. Updates `scene`'s light table (GpuScene::updateLights).
    void update(gl::ProgramLibrary& programs, gl::Profiler& profiler, scene::GpuScene& scene,
                const LightSettings& settings);
    void bind() const;

    static std::vector<gl::ProgramDesc> programDescs();

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace conelight::light
