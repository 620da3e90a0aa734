// SPDX-License-Identifier: MIT
// The pictures that a PathTracedPicture holds, by the names of their layers in files: full, direct, indirect,
// diffuse, specular, half_a, half_b, indirect_half_a, indirect_half_b, bounce1 to bounce64.
#pragma once

#include <string>

#include "reference/path_tracer.h"

namespace conelight::reference {

// Null when there is none of this name.
const Image* layerOf(const PathTracedPicture& picture, const std::string& name);
Image* layerOf(PathTracedPicture& picture, const std::string& name);
// N of "bounceN", 1 to 64; 0 for every other name. PathTracerSettings::perBounce asks for so many.
int bounceLayer(const std::string& name);
// Layers that are no components: halves and bounces; and their names, for messages.
bool isTracedLayer(const std::string& name);
std::string tracedLayerNames();

}  // namespace conelight::reference
