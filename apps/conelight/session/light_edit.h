// SPDX-License-Identifier: MIT
// Changes of lights that console and panels share.
#pragma once

#include <string>

#include "conelight/scene.h"

namespace conelight::program {

// Where it shines; `direction` has a length. A rectangle keeps its width and height while it turns; its
// height runs upward as far as it can.
void aimLight(Light& light, const glm::vec3& direction);

// A light at the eye that shines where the camera looks: it is seen at once, and can be moved from there.
Light lightAt(const Camera& camera, LightType type, const std::string& name);

}  // namespace conelight::program
