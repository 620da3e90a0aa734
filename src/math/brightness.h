// SPDX-License-Identifier: MIT
// How bright a colour counts as where light is drawn or compared: blue as much as green, as in shaders
// (lib/face_shading.glsl).
#pragma once

#include <glm/glm.hpp>

namespace conelight::math {

inline float brightness(const glm::vec3& color) { return (color.r + color.g + color.b) / 3; }

}  // namespace conelight::math
