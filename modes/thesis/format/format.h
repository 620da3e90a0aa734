// SPDX-License-Identifier: MIT
// The thesis's scene text format (.txt .scene) among the formats that conelight_io reads and writes, and
// rooms like its own among the generated scenes.
#pragma once

namespace conelight::thesis {

// Call before scenes are loaded, from one thread; a second call does nothing.
void registerThesisFormat();

}  // namespace conelight::thesis
