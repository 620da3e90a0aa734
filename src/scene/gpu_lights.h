// SPDX-License-Identifier: MIT
// Lights of the scene -> the light table of shared/scene.h: enabled ones only, sorted by the way they are
// evaluated (kinds in the order of LIGHT_*), within a kind in the scene's order.
#pragma once

#include <vector>

#include "conelight/scene.h"
#include "shared/scene.h"

namespace conelight::scene {

std::vector<gpu::Light> packedLights(const std::vector<Light>& lights);

// Where the ranges of points, spots, directional lights and rectangles end in a sorted table.
glm::uvec4 lightEnds(const std::vector<gpu::Light>& lights);

}  // namespace conelight::scene
