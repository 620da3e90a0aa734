// SPDX-License-Identifier: MIT
// Rooms like those of the thesis among the generated scenes (builtin:thesis-...): its walls, lamps, falloff,
// Phong materials and cameras, with bodies made by code. Private to this room.
#pragma once

namespace conelight::thesis {

void registerThesisScenes();

}  // namespace conelight::thesis
