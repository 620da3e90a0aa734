// SPDX-License-Identifier: MIT
// A set of cones as a JSON file:
//
//     {"cones": [{"direction": [0, 0, 1], "aperture": 0.9, "weight": 1.2}, ...]}
//
// direction: z is the surface's normal; aperture: full angle in rad; weights are scaled to the sum pi.
// Limits: SetCone in conelight/settings.h.
#pragma once

#include <string>
#include <vector>

#include "conelight/settings.h"

namespace conelight::io {

// Throws Error(BadInput) "FILE:LINE: what is wrong".
std::vector<SetCone> readConeSet(const std::string& path);

// Throws Error(Runtime) that names the path.
void writeConeSet(const std::string& path, const std::vector<SetCone>& cones);

}  // namespace conelight::io
