// SPDX-License-Identifier: MIT
// Cameras as computer vision writes them: x_pixel ~ K (R x + t), camera axes x right, y down, z forward. The
// library's cameras have square pixels and look at the picture's centre.
#pragma once

#include <glm/glm.hpp>

#include "conelight/scene.h"

namespace conelight::python {

struct OpencvCamera {
    glm::dmat3 intrinsics{1.0};       // K, pixels
    glm::dmat3 cameraFromWorld{1.0};  // R
    glm::dvec3 translation{0.0};      // t, metres
    // Coordinates of the first pixel's centre: 0 in OpenCV, 0.5 in COLMAP and where the corner is the origin.
    double pixelCenter = 0;
};

// Throws Error(Usage) for what the library's cameras cannot show: unequal focal lengths, skew, a principal point
// off the centre (all by a hundredth of a pixel at the picture's edge), an R that is no rotation.
Camera cameraFrom(const OpencvCamera& opencv, const glm::ivec2& size);
OpencvCamera opencvFrom(const Camera& camera, const glm::ivec2& size, double pixelCenter);

}  // namespace conelight::python
