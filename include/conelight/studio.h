// SPDX-License-Identifier: MIT
// The studio in which models without light are seen: even surroundings, a soft lamp, and a ground to stand on.
#pragma once

#include <memory>

#include "conelight/export.h"
#include "conelight/scene.h"

namespace conelight {

// Radiances of its parts, W/(sr m^2).
struct StudioLevels {
    double key = 12;     // of the large lamp
    double fill = 3;     // of the lamps beside and behind
    double room = 0.35;  // of the room around them
    double floor = 0;    // of all that is below the horizon; the room goes over into it. 0: the room goes on
};

// The surroundings, a camera that looks along -z having the large lamp to its left. Deterministic, thread-safe.
CONELIGHT_API std::shared_ptr<const EnvironmentImage> studioPicture(const StudioLevels& levels);

struct CompletionOptions {
    bool ground = true;  // below what has neither light nor a floor of its own
};

// Names of what is added to scenes without light.
inline constexpr const char* kStudioLightName = "studio light";
inline constexpr const char* kStudioGroundName = "studio ground";

// As completeScene(scene), which adds a ground.
CONELIGHT_API void completeScene(Scene& scene, const CompletionOptions& options);

}  // namespace conelight
