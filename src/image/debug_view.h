// SPDX-License-Identifier: MIT
// Pictures of the G-buffer itself: Component::Albedo, Normal, Depth and Emission, the same in every mode.
// GBuffer -> output. Normal: world axes mapped from [-1,1] to [0,1]. Depth: metres along the view axis.
#pragma once

#include <vector>

#include "conelight/settings.h"
#include "gl/device.h"
#include "gl/texture.h"
#include "view/surfaces.h"

namespace conelight::image {

bool isDebugView(Component component);
// Reads: frame block, scene tables, G-buffer. Writes `output` (RGBA32F) as an image.
void drawDebugView(const gl::Device& device, const scene::GpuScene& scene, const view::Surfaces& surfaces,
                   Component component, const gl::Texture& output);
std::vector<gl::ProgramDesc> debugViewProgramDescs();

}  // namespace conelight::image
