// SPDX-License-Identifier: MIT
// The Phong model per pixel: surfaces, lights, materials -> RGBA32F image. Readers of `output` need a
// texture-fetch barrier. GL state changed: program and its slots.
#pragma once

#include <vector>

#include "base/steps.h"
#include "gather/direct_light.h"
#include "gl/device.h"
#include "gl/texture.h"

namespace conelight::gather {

// `shadows`: with the shadow maps of the lights; else every light reaches every surface that faces it.
base::Steps drawPhongShade(const gl::Device& device, const DirectInputs& inputs, bool shadows,
                           const gl::Texture& output);

std::vector<gl::ProgramDesc> phongShadeProgramDescs();

}  // namespace conelight::gather
