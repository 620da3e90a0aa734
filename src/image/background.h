// SPDX-License-Identifier: MIT
// The environment's picture behind all surfaces of an image, in every mode.
//
// Ends with the barriers for texture fetches and framebuffers. GL state changed: program and its slots.
#pragma once

#include <vector>

#include "base/steps.h"
#include "gl/device.h"
#include "gl/texture.h"
#include "light/lights.h"
#include "scene/gpu_scene.h"
#include "view/surfaces.h"

namespace conelight::image {

// Into the pixels of `picture` (RGBA32F, of the size of `surfaces`) that see no surface; alpha 0. Without an
// environment nothing is drawn.
base::Steps drawBackground(const gl::Device& device, const scene::GpuScene& scene,
                           const light::Lights& lights, const view::Surfaces& surfaces,
                           const gl::Texture& picture);
std::vector<gl::ProgramDesc> backgroundProgramDescs();

}  // namespace conelight::image
