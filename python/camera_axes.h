// SPDX-License-Identifier: MIT
// How large a camera's pixels are, and which cameras see anything.
#pragma once

#include "conelight/scene.h"

namespace conelight::python {

// Of a picture so many pixels high, at depth 1 m; of parallel rays at any depth.
double pixelSize(const Camera& camera, int height);

// Throws Error(Usage) for a camera that sees nothing: an angle out of range, no view direction, planes in
// disorder.
void checkCamera(const Camera& camera);

}  // namespace conelight::python
