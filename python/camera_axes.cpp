// SPDX-License-Identifier: MIT
#include "camera_axes.h"

#include <fmt/core.h>

#include <cmath>

#include "conelight/error.h"

namespace conelight::python {

double pixelSize(const Camera& camera, int height) {
    const double whole =
        camera.isOrthographic() ? double(camera.orthographicHeight) : 2 * std::tan(0.5 * double(camera.fovY));
    return whole / height;
}

void checkCamera(const Camera& camera) {
    const auto fail = [](const std::string& what) { throw Error(ErrorKind::Usage, "camera: " + what); };
    if (!(camera.fovY > 0) || !(camera.fovY < 3.1415926f))
        fail(fmt::format("vfov {} is out of range; an angle between 0 and pi, in radians, would be right",
                         camera.fovY));
    if (!(camera.zNear > 0) || !(camera.zFar > camera.zNear) || !std::isfinite(camera.zFar))
        fail(fmt::format("near {} and far {}; 0 < near < far would be right", camera.zNear, camera.zFar));
    if (!(camera.orthographicHeight >= 0) || !std::isfinite(camera.orthographicHeight))
        fail(fmt::format("orthographic_height {}; 0 or more would be right", camera.orthographicHeight));
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
