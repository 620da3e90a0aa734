// SPDX-License-Identifier: MIT
// Which instances are thin boxes that shine (scene/small_lamps.h): six parallelograms about a middle. No GL.
#pragma once

#include <vector>

#include "scene/small_lamps.h"

namespace conelight::scene {

// Those of which half the thickness is below `largest`, if they are no more than kMostEmissiveBoxes: a light for each of
// six sides.
void addEmissiveBoxes(const Scene& scene, float largest, std::vector<SmallLamp>& lamps);

}  // namespace conelight::scene
