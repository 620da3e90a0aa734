// SPDX-License-Identifier: MIT
// Which pixels of a picture show a material before anything else: Scene + Camera -> 1 or 0 per pixel. What the
// errors of a part of a picture are measured on.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "conelight/scene.h"
#include "reference/path_tracer.h"

namespace conelight::reference {

using MaterialChoice = std::function<bool(const Material&)>;

// Rows from the top. A pixel counts where the camera's ray through its centre meets the material first; with
// PixelFilter::Box where any of 4 x 4 rays does, so that edges count as well. A lens is taken for a pinhole. Throws what
// RayScene throws.
std::vector<std::uint8_t> pixelsThatSee(const Scene& scene, const Camera& camera, int width, int height,
                                        PixelFilter filter, const MaterialChoice& chosen);

}  // namespace conelight::reference
