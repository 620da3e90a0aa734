// SPDX-License-Identifier: MIT
// FrameStats as JSON, in the words of `render --stats` and `bench --json`.
#pragma once

#include <nlohmann/json.hpp>

#include "conelight/renderer.h"

namespace conelight::program {

// {"device", "frame": {"cpu_ms", "wall_ms"}, "passes": [{"name","cpu_ms","wall_ms","gpu_ms"}],
//  "lookups_per_pixel": {...}, "memory_bytes": {label: bytes ...,"total"}}
nlohmann::ordered_json statsJson(const FrameStats& stats);
nlohmann::ordered_json memoryJson(const FrameStats& stats);
nlohmann::ordered_json lookupsJson(const FrameStats& stats);

// Indented, with a line end.
void writeJson(const std::string& path, const nlohmann::ordered_json& json);

// --bounces N|all.
void applyBounces(Settings& settings, const std::string& bounces);

}  // namespace conelight::program
