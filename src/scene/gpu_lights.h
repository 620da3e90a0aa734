// SPDX-License-Identifier: MIT
// Lights of the scene -> the light table of shared/scene.h: enabled ones only, sorted by the way they are
// evaluated (kinds in the order of LIGHT_*), within a kind in the scene's order.
#pragma once

#include <memory>
#include <vector>

#include "conelight/scene.h"
#include "shared/scene.h"

namespace conelight::scene {

// The profiles that enabled lights have, each once, in the order of layers of the table of profiles.
using Profiles = std::vector<std::shared_ptr<const LightProfile>>;
constexpr std::size_t kMostProfiles = 256;  // further ones are left out
Profiles profilesOf(const std::vector<Light>& lights);

std::vector<gpu::Light> packedLights(const std::vector<Light>& lights);

// m^2, of an area light; of a sphere that of its disc, as lib/rect_points.glsl's.
float areaOf(const gpu::Light& light);

// Where the ranges of points, spots, directional lights and area lights end in a sorted table.
glm::uvec4 lightEnds(const std::vector<gpu::Light>& lights);

}  // namespace conelight::scene
