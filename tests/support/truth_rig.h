// SPDX-License-Identifier: MIT
// Cameras and reductions of pictures for tests of the path tracer: what a diffuse plane shows is the
// irradiance on it.
#pragma once

#include "conelight/scene.h"
#include "reference/path_tracer.h"
#include "support/scenes.h"

namespace conelight::test {

// A camera that looks from `height` above straight down (-y) on a square of edge `width` about `point`.
Camera cameraAbove(const glm::vec3& point, float height, float width);
// One that looks at the origin from a metre away, `angle` off the vertical (y), on next to nothing of it.
Camera cameraSlanted(double angle);

// A horizontal square about the origin.
Mesh groundMesh(float half);

// Mean over all pixels and channels (alpha left out); NaN where one is not finite.
double meanOf(const Image& image);
glm::dvec3 meanColorOf(const Image& image);

// sqrt(mean (a - b)^2) / mean(b).
double relRmse(const Image& a, const Image& b);

}  // namespace conelight::test
