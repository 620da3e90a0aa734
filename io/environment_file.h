// SPDX-License-Identifier: MIT
// Environments from files and made by code: a latitude-longitude picture (.exr .hdr, or .png .jpg as 8-bit),
// or `builtin:NAME?key=value&...` (generated_surroundings.h).
#pragma once

#include <optional>
#include <string>

#include "conelight/export.h"
#include "conelight/scene.h"

namespace conelight::io {

struct LoadedEnvironment {
    Environment environment;   // rotation 0, strength 1
    std::optional<Light> sun;  // of a generated sky: too small for a picture, so a light of its own
};

// Throws Error(BadInput), one line that starts with the path: not readable, not twice as wide as high, a value
// that is not finite. Negative values, which filters leave behind, are taken as 0. Throws Error(Usage) for an
// unknown builtin, and for an extension nobody reads. Thread-safe.
CONELIGHT_API LoadedEnvironment loadEnvironment(const std::string& pathOrBuiltin);

// Puts it into a scene in place of what was there, turned counter-clockwise as seen from above (rad) and with all
// its radiance multiplied by `strength`. Its sun takes the place of the one that a generated sky brought before.
CONELIGHT_API void useEnvironment(Scene& scene, LoadedEnvironment loaded, float rotation, float strength);

}  // namespace conelight::io
