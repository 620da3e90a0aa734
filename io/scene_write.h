// SPDX-License-Identifier: MIT
// Scenes to files: glTF 2.0 (.gltf .glb) and registered formats (scene_format.h).
#pragma once

#include <string>
#include <vector>

#include "conelight/export.h"
#include "conelight/scene.h"

namespace conelight::io {

// Writes `scene` in the format that the extension names; Scene::settings go along where the format has a
// place for them. Returns what it could not hold, one line each. Throws Error(Usage) for an extension that is
// not written, and when a file is there already and `force` is not given; Error(Runtime) when a file cannot
// be written. Nothing is half-written.
CONELIGHT_API std::vector<std::string> writeScene(const std::string& path, const Scene& scene, bool force);

// In lower case with dot, for help texts and completion.
CONELIGHT_API std::vector<std::string> writtenSceneExtensions();

}  // namespace conelight::io
