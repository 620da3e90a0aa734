// SPDX-License-Identifier: MIT
// A scene in words, for `conelight info SCENE`.
#pragma once

#include <string>

#include "conelight/scene.h"

namespace conelight::io {

// point, spot, directional, rect; and the unit of such a light's intensity.
const char* lightTypeName(LightType type);
const char* lightUnit(LightType type);

// Several lines, each ended by a line feed: counts, triangles, bounds, materials, textures with sizes and
// memory, lights with type and unit, cameras, sky, settings, notes. Long lists are cut after `maxRows` rows.
std::string describeScene(const Scene& scene, std::size_t maxRows = 32);

// A line for each name of an instance, in order of the first that has it, and how many have it. Instances without a name
// are one line at the end.
std::string describeObjects(const Scene& scene);

}  // namespace conelight::io
