// SPDX-License-Identifier: MIT
#include "opencv_camera.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "camera_axes.h"
#include "conelight/error.h"

namespace conelight::python {
namespace {

[[noreturn]] void fail(const std::string& message) { throw Error(ErrorKind::Usage, message); }

constexpr double kMostOffPx = 0.01;  // by eye: below what a picture shows

void checkIntrinsics(const OpencvCamera& opencv, const glm::ivec2& size) {
    const glm::dmat3& k = opencv.intrinsics;
    const double fx = k[0][0], fy = k[1][1];
    if (!(fx > 0) || !(fy > 0) || !std::isfinite(fx) || !std::isfinite(fy))
        fail(fmt::format("K: focal lengths {} and {}; numbers above 0, in pixels, would be right", fx, fy));
    if (std::abs(fx - fy) / fy * 0.5 * size.x > kMostOffPx)
        fail(fmt::format("K: focal lengths {} and {} differ; pixels are square, equal ones would be right",
                         fx, fy));
    if (std::abs(k[1][0]) / fy * 0.5 * size.y > kMostOffPx) fail("K: has skew; 0 would be right");
    const glm::dvec2 point(k[2]), centre = 0.5 * glm::dvec2(size) - 0.5 + opencv.pixelCenter;
    const glm::dvec2 off = glm::abs(point - centre);
    if (!(off.x <= kMostOffPx) || !(off.y <= kMostOffPx)) {
        const bool isHalf = std::abs(off.x - 0.5) <= kMostOffPx && std::abs(off.y - 0.5) <= kMostOffPx;
        fail(fmt::format(
            "K: principal point {}, {} is not the picture's centre; {}, {}{} would be right", point.x,
            point.y, centre.x, centre.y,
            isHalf ? fmt::format(", or pixel_center={}", opencv.pixelCenter == 0 ? 0.5 : 0.0) : ""));
    }
}

}  // namespace

Camera cameraFrom(const OpencvCamera& opencv, const glm::ivec2& size) {
    checkIntrinsics(opencv, size);
    const glm::dmat3& r = opencv.cameraFromWorld;
    const glm::dmat3 product = r * glm::transpose(r);
    double off = std::abs(glm::determinant(r) - 1);
    for (int i = 0; i < 3; ++i) off = std::max(off, glm::length(product[i] - glm::dmat3(1.0)[i]));
    if (!(off < 1e-3)) fail("R: is no rotation; an orthonormal matrix of determinant 1 would be right");
    const glm::dmat3 worldFromCamera = glm::transpose(r);
    const glm::dvec3 eye = -(worldFromCamera * opencv.translation);
    if (!std::isfinite(glm::dot(eye, eye))) fail("t: is not finite");
    Camera camera;
    camera.eye = glm::vec3(eye);
    // Far enough that rounding of the target does not turn the view.
    camera.target = glm::vec3(eye + worldFromCamera[2] * (1.0 + glm::length(eye)));
    camera.up = glm::vec3(-worldFromCamera[1]);
    camera.fovY = static_cast<float>(2 * std::atan(0.5 * size.y / opencv.intrinsics[1][1]));
    return camera;
}

OpencvCamera opencvFrom(const Camera& camera, const glm::ivec2& size, double pixelCenter) {
    if (camera.isOrthographic())
        fail(
            "orthographic_height: parallel rays have no focal length; a camera in perspective would be "
            "right");
    const CameraAxes axes = cameraAxes(camera);
    const double f = 0.5 * size.y / std::tan(0.5 * double(camera.fovY));
    OpencvCamera opencv;
    opencv.pixelCenter = pixelCenter;
    opencv.intrinsics =
        glm::dmat3(f, 0, 0, 0, f, 0, 0.5 * size.x - 0.5 + pixelCenter, 0.5 * size.y - 0.5 + pixelCenter, 1);
    opencv.cameraFromWorld = glm::transpose(glm::dmat3(axes.right, -axes.up, axes.forward));
    opencv.translation = -(opencv.cameraFromWorld * glm::dvec3(camera.eye));
    return opencv;
}

}  // namespace conelight::python
