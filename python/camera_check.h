// SPDX-License-Identifier: MIT
#pragma once

#include "conelight/scene.h"

namespace conelight::python {

// Throws Error(Usage) for a camera that sees nothing: an angle out of range, no view direction, planes in disorder.
void checkCamera(const Camera& camera);

}  // namespace conelight::python
