// SPDX-License-Identifier: MIT
// The path tracer as the commands use it: progress on a terminal, a stop by Ctrl-C that keeps what is there.
#pragma once

#include <string>
#include <vector>

#include "command.h"
#include "reference/path_tracer.h"

namespace conelight::program {

// Renders; `progress` may be null. A signal during it makes it return early, interrupted() is true then.
reference::PathTracedPicture trace(const reference::PathTracer& tracer, const Camera& camera,
                                   const Size& size, const reference::PathTracerSettings& settings,
                                   Progress* progress);

// The part of it that shows `component`. Throws Error(Usage) for one that a path tracer does not have.
const Image& imageOf(const reference::PathTracedPicture& picture, Component component);

// Every picture it holds by the name of its layer: direct, indirect, diffuse, specular, half_a, half_b,
// indirect_half_a, indirect_half_b, bounce1 ... ; null when there is none of this name.
const Image* layerOf(const reference::PathTracedPicture& picture, const std::string& name);
// N of "bounceN", N >= 1; 0 for every other name.
int bounceLayer(const std::string& name);
// Layers that are no components: halves and bounces; and their names, for messages.
bool isTracedLayer(const std::string& name);
std::string tracedLayerNames();

// "12 s", "3 min 20 s", "2 h 5 min".
std::string timeText(double seconds);

}  // namespace conelight::program
