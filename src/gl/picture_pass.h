// SPDX-License-Identifier: MIT
// A compute pass with an invocation per pixel: at once, or in bands of rows with rests between them (gl/pace.h). Its
// shader asks passPixel() of lib/picture_pass.glsl.
#pragma once

#include <glm/glm.hpp>

#include "base/steps.h"
#include "gl/device.h"

namespace conelight::gl {

struct PicturePass {
    const char* name;  // of its scope
    const ProgramDesc& desc;
    const Inputs& inputs;  // without the first row
    glm::ivec2 size;
};

// What it writes is visible after the barrier that its readers need. GL state changed: program and its slots.
base::Steps dispatchPicture(const Device& device, PicturePass pass);

}  // namespace conelight::gl
