// SPDX-License-Identifier: MIT
// Baked light of mode hybrid as the commands use it: progress on a terminal, a note on standard error where nothing
// moves, a stop by Ctrl-C.
#pragma once

#include <memory>

#include "command.h"
#include "static_bake.h"

namespace conelight::program {

// What `bake` has or makes of the scene; `progress` may be null. A signal during it makes it return early,
// interrupted() is true then.
std::shared_ptr<const BakedLight> staticLight(StaticBake& bake, const Scene& scene,
                                              const reference::RadiositySettings& settings,
                                              Progress* progress);

}  // namespace conelight::program
