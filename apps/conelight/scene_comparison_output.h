// SPDX-License-Identifier: MIT
// What `conelight compare SCENE` writes: a table, JSON, and the pictures as EXR files.
#pragma once

#include <nlohmann/json.hpp>

#include <string>

#include "scene_comparison.h"

namespace conelight::program {

void printComparison(const SceneComparison& comparison, bool withFlip);

// {"scene","against","camera","size","reference":{"origin","samples_per_pixel","noise","cpu_seconds","rays"},
//  "variants":[{"mode","label","settings":{..},"components":{"full":{..metrics..}},
//  "frame":{"cpu_ms","wall_ms","gpu_ms"},"lookups_per_pixel":{..},"memory_bytes","radiosity":{..}}]}
nlohmann::ordered_json comparisonJson(const SceneComparison& comparison, bool withFlip);

// Each variant's picture with its components as layers, as DIR/SCENE-VARIANT.exr. Returns the files, in
// order. `device`: of OpenGL.
std::vector<std::string> writeVariants(const SceneComparison& comparison, const std::string& directory,
                                       const std::string& device);

}  // namespace conelight::program
