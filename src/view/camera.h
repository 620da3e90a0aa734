// SPDX-License-Identifier: MIT
// Matrices of a camera, and what shaders know of it. Computed in double, given in float.
#pragma once

#include "conelight/scene.h"
#include "shared/frame.h"

namespace conelight::view {

glm::mat4 viewFromWorld(const Camera& camera);
glm::mat4 clipFromView(const Camera& camera, int width, int height);  // GL clip space, z in [-1,1]

gpu::FrameConstants frameConstants(const Camera& camera, int width, int height);

}  // namespace conelight::view
