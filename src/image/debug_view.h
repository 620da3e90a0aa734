// SPDX-License-Identifier: MIT
// Pictures of the G-buffer itself: Component::Albedo, Normal, Depth and Emission, the same in every mode.
// GBuffer -> output. Normal: world axes mapped from [-1,1] to [0,1]. Depth: metres along the view axis.
#pragma once

#include "conelight/settings.h"
#include "gl/pass.h"
#include "gl/program.h"
#include "view/gbuffer.h"

namespace conelight::image {

bool isDebugView(Component component);
// Reads: frame block, scene tables, G-buffer. Writes `output` (RGBA32F) as an image.
void drawDebugView(gl::ProgramLibrary& programs, gl::Profiler& profiler, const view::GBuffer& gbuffer,
                   Component component, const gl::Texture& output);
std::vector<gl::ProgramDesc> debugViewProgramDescs();

}  // namespace conelight::image
