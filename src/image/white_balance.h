// SPDX-License-Identifier: MIT
// White balance: the matrix that brings the light of a lamp to white (docs/theory/5_image.md, "Tone map").
#pragma once

#include <glm/glm.hpp>

namespace conelight::image {

// For linear Rec.709. `kelvin`, `tint`: ImageSettings::whiteBalance and tint. Luminance of white stays. The identity at
// 6500 and 0.
glm::mat3 whiteBalance(float kelvin, float tint);

}  // namespace conelight::image
