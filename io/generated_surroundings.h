// SPDX-License-Identifier: MIT
// Surroundings made by code: a clear sky by time and place, and a studio with soft lamps.
// Deterministic: the same specification gives the same picture, bit by bit.
#pragma once

#include <span>
#include <string>

#include "io/environment_file.h"
#include "io/generated.h"

namespace conelight::io {

constexpr const char* kGeneratedSunName = "sky's sun";

// All that generateSurroundings knows, in the order in which help should list them.
std::span<const GeneratedSceneInfo> generatedSurroundings();

// Makes the surroundings NAME or NAME?key=value&key=value, e.g. "sky?hour=17". Throws Error(Usage), one line
// that names what is known, as generateScene does; and for a sky whose sun is below the horizon. Thread-safe.
LoadedEnvironment generateSurroundings(const std::string& spec);

}  // namespace conelight::io
