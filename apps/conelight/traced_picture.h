// SPDX-License-Identifier: MIT
// The path tracer and the beam tracer as the commands use them: progress on a terminal, a stop by Ctrl-C that keeps what is there.
#pragma once

#include <string>
#include <vector>

#include "command.h"
#include "reference/beam_tracer.h"
#include "reference/path_tracer.h"

namespace conelight::program {

// Renders; `progress` may be null. A signal during it makes it return early, interrupted() is true then.
reference::PathTracedPicture trace(const reference::PathTracer& tracer, const Camera& camera,
                                   const Size& size, const reference::PathTracerSettings& settings,
                                   Progress* progress);

// The part of it that shows `component`. Throws Error(Usage) for one that a path tracer does not have.
const Image& imageOf(const reference::PathTracedPicture& picture, Component component);

// The same of beams.
reference::BeamPicture traceBeams(const Scene& scene, const Camera& camera, const Size& size,
                                  const reference::BeamSettings& settings, Progress* progress);
Image imageOf(const reference::BeamPicture& picture, Component component);

// "12 s", "3 min 20 s", "2 h 5 min".
std::string timeText(double seconds);

}  // namespace conelight::program
