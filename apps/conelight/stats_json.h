// SPDX-License-Identifier: MIT
// What a picture cost as JSON, in the words of `render --stats` and `bench --json`.
#pragma once

#include <nlohmann/json.hpp>

#include "conelight/renderer.h"
#include "reference/beam_tracer.h"
#include "reference/path_tracer.h"
#include "reference/radiosity.h"

namespace conelight::program {

// {"device", "frame": {"cpu_ms", "wall_ms"}, "passes": [{"name","cpu_ms","wall_ms","gpu_ms"}],
//  "lookups_per_pixel": {...}, "memory_bytes": {label: bytes ...,"total"}}
nlohmann::ordered_json statsJson(const FrameStats& stats);
nlohmann::ordered_json memoryJson(const FrameStats& stats);
nlohmann::ordered_json lookupsJson(const FrameStats& stats);
// {"samples_per_pixel", "noise", "rays", "rays_per_second", "cpu_seconds", "wall_seconds"}
nlohmann::ordered_json tracedJson(const reference::PathTracedPicture& picture);
// {"patches", "elements", "vertices", "iterations", "residual", "rays", "cpu_seconds", "wall_seconds"}
nlohmann::ordered_json bakeJson(const reference::RadiosityStats& stats);
nlohmann::ordered_json beamsJson(const reference::BeamStats& stats);

// Indented, with a line end.
void writeJson(const std::string& path, const nlohmann::ordered_json& json);

}  // namespace conelight::program
