// SPDX-License-Identifier: MIT
// Mode `thesis`: the renderer of the bachelor's thesis that Conelight grew from, as a guest of the library
// (docs/guide/thesis_mode.md). A host that wants it links conelight::thesis and registers it.
#pragma once

#include "conelight/export.h"

namespace conelight::thesis {

// Scene::format of scenes with the thesis's conventions.
inline constexpr const char* kSceneFormat = "thesis";

// Adds the mode, its settings and its shaders to the library's lists. Call before the first Renderer, from
// one thread; a second call does nothing. Scene format and console commands: format/format.h and
// console/commands.h.
CONELIGHT_API void registerThesis();

}  // namespace conelight::thesis
