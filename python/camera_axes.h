// SPDX-License-Identifier: MIT
// A camera's axes as the renderer has them, and which cameras see anything.
#pragma once

#include <glm/glm.hpp>

#include "conelight/scene.h"

namespace conelight::python {

struct CameraAxes {
    glm::dvec3 right, up, forward;  // unit, at right angles
};
CameraAxes axesOf(const Camera& camera);
// Of a picture so many pixels high, at depth 1 m; of parallel rays at any depth.
double pixelSize(const Camera& camera, int height);

// Throws Error(Usage) for a camera that sees nothing: an angle out of range, no view direction, planes in
// disorder.
void checkCamera(const Camera& camera);

}  // namespace conelight::python
