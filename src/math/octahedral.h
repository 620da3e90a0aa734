// SPDX-License-Identifier: MIT
// Unit vectors as two numbers: octahedral mapping (Meyer et al. 2010, "On Floating-Point Normal Vectors").
// GLSL twin: shaders/lib/octahedral.glsl.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

namespace conelight::math {

glm::vec2 octEncode(const glm::vec3& n);          // unit vector -> [-1,1]^2
glm::vec3 octDecode(const glm::vec2& p);          // inverse, unit length
std::uint32_t packSnorm2x16(const glm::vec2& v);  // as GLSL's packSnorm2x16
glm::vec2 unpackSnorm2x16(std::uint32_t bits);

}  // namespace conelight::math
