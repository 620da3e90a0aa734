// SPDX-License-Identifier: MIT
// A pixel's cones and rays (conelight/inspect.h) as lines of text and as JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "conelight/inspect.h"

namespace conelight::program {

// One line per path, its steps below it when asked for.
std::vector<std::string> inspectionText(const PixelInspection& pixel, bool steps);
// Everything; numbers in the units of conelight/inspect.h, which the keys name.
nlohmann::ordered_json inspectionJson(const PixelInspection& pixel);

}  // namespace conelight::program
