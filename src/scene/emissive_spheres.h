// SPDX-License-Identifier: MIT
// Which instances are small balls that shine (scene/small_lamps.h). No GL.
#pragma once

#include <vector>

#include "scene/small_lamps.h"

namespace conelight::scene {

// Those of a radius below `largest`, if they are no more than kMostEmissiveSpheres. A light has the area of the mesh, which
// lies within its own sphere of corners.
void addEmissiveSpheres(const Scene& scene, float largest, std::vector<SmallLamp>& lamps);

}  // namespace conelight::scene
