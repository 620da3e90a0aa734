// SPDX-License-Identifier: MIT
// Pictures of surroundings that tests put round their scenes.
#pragma once

#include <memory>

#include "conelight/scene.h"

namespace conelight::test {

std::shared_ptr<EnvironmentImage> evenEnvironment(int width, const glm::vec3& radiance);
// Uneven, bluish, with one texel 10^5 times as bright, 50 degrees above the horizon, ahead and to the right.
std::shared_ptr<EnvironmentImage> sunnyEnvironment(int width);

}  // namespace conelight::test
