// SPDX-License-Identifier: MIT
// Phong's model per pixel: G-buffer, light table, materials (and shadow maps) -> RGBA32F image.
//
// Reads: G-buffer, frame block, scene tables, shadow maps (all bound). Writes: `output`; readers need a
// texture-fetch barrier.
#pragma once

#include "conelight/settings.h"
#include "gl/pass.h"
#include "gl/program.h"
#include "gl/texture.h"
#include "scene/gpu_scene.h"

namespace conelight::gather {

// `shadows`: with the shadow maps of `settings`; else every light reaches every surface that faces it.
void drawPhongShade(gl::ProgramLibrary& programs, gl::Profiler& profiler, const scene::GpuScene& scene,
                    const LightSettings& settings, bool shadows, const gl::Texture& output);

std::vector<gl::ProgramDesc> phongShadeProgramDescs();

}  // namespace conelight::gather
