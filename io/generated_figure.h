// SPDX-License-Identifier: MIT
// A figure that walks, for generated scenes. Internal to conelight_io.
#pragma once

#include "io/animation.h"

namespace conelight::io::generated {

// Adds one that walks along +x for kWalkSeconds from `start`, its feet on that height; it stands in mid-stride.
void addWalkingFigure(Scene& scene, glm::vec3 start);
inline constexpr float kWalkSeconds = 4;

// The clip "walk" of the figure in the scene; empty without one.
SceneAnimation figureAnimation(const Scene& scene);

}  // namespace conelight::io::generated
