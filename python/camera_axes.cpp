// SPDX-License-Identifier: MIT
#include "camera_axes.h"

#include <fmt/core.h>

#include <cmath>

#include "conelight/error.h"
#include "session/picker.h"

namespace conelight::python {

CameraAxes axesOf(const Camera& camera) {
    const auto toward = [&](float x, float y) {
        return glm::dvec3(program::rayDirection(camera, 1.0f, glm::vec2(x, y)));
    };
    CameraAxes axes;
    axes.forward = glm::normalize(glm::dvec3(camera.target) - glm::dvec3(camera.eye));
    // Where up lies along the view, the renderer has a right of its own.
    glm::dvec3 right = glm::cross(axes.forward, glm::dvec3(camera.up));
    if (!(glm::length(right) > 1e-6 * glm::length(glm::dvec3(camera.up))))
        right = toward(1, 0) - toward(-1, 0);
    axes.right = glm::normalize(right);
    axes.up = glm::cross(axes.right, axes.forward);
    return axes;
}

void checkCamera(const Camera& camera) {
    const auto fail = [](const std::string& what) { throw Error(ErrorKind::Usage, "camera: " + what); };
    if (!(camera.fovY > 0) || !(camera.fovY < 3.1415926f))
        fail(fmt::format("vfov {} is out of range; an angle between 0 and pi, in radians, would be right",
                         camera.fovY));
    if (!(camera.zNear > 0) || !(camera.zFar > camera.zNear) || !std::isfinite(camera.zFar))
        fail(fmt::format("near {} and far {}; 0 < near < far would be right", camera.zNear, camera.zFar));
    if (!(camera.lensDiameter >= 0) || !std::isfinite(camera.lensDiameter))
        fail(fmt::format("lens_diameter {}; 0 or more would be right", camera.lensDiameter));
    if (!(camera.focusDistance >= 0) || !std::isfinite(camera.focusDistance))
        fail(fmt::format("focus_distance {}; 0 or more would be right", camera.focusDistance));
    const glm::vec3 view = camera.target - camera.eye;
    if (!std::isfinite(glm::dot(view, view)) || !std::isfinite(glm::dot(camera.up, camera.up)))
        fail("a number is not finite");
    if (!(glm::length(view) > 1e-9f)) fail("eye and target are the same point; two points would be right");
}

}  // namespace conelight::python
