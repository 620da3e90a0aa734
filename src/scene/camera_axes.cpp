// SPDX-License-Identifier: MIT
#include "conelight/scene.h"

namespace conelight {

CameraAxes cameraAxes(const Camera& camera) {
    CameraAxes axes;
    const glm::dvec3 view = glm::dvec3(camera.target) - glm::dvec3(camera.eye), up = camera.up;
    const double distance = glm::length(view);
    axes.forward = distance > 0 ? view / distance : glm::dvec3(0, 0, -1);
    glm::dvec3 side = glm::cross(axes.forward, up);
    // 1e-6: below a microradian between view and up, rounding decides where right is.
    if (!(glm::length(side) > 1e-6 * glm::length(up))) {
        const glm::dvec3 away = glm::abs(axes.forward);
        side = glm::cross(axes.forward, away.y <= away.x && away.y <= away.z ? glm::dvec3(0, 1, 0)
                                        : away.z <= away.x                   ? glm::dvec3(0, 0, -1)
                                                                             : glm::dvec3(1, 0, 0));
    }
    axes.right = glm::normalize(side);
    axes.up = glm::cross(axes.right, axes.forward);
    return axes;
}

}  // namespace conelight
