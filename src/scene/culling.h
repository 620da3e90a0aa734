// SPDX-License-Identifier: MIT
// What a view cannot see.
#pragma once

#include "conelight/scene.h"

namespace conelight::scene {

// True when the box is outside one of the planes of clip space (no far plane: depth is reversed, far is 0), by more
// than rounding. `clipFromBox`: from the box's space.
bool isOutside(const glm::mat4& clipFromBox, const Aabb& box);

}  // namespace conelight::scene
