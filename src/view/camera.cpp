// SPDX-License-Identifier: MIT
#include "view/camera.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>
#include <numeric>

#include "base/log.h"
#include "math/disc.h"

namespace conelight::view {
namespace {

glm::dmat4 viewMatrix(const Camera& camera) {
    const CameraAxes axes = cameraAxes(camera);
    const glm::dvec3 eye(camera.eye);
    glm::dmat4 m(1.0);
    for (int i = 0; i < 3; ++i) {
        m[i][0] = axes.right[i];
        m[i][1] = axes.up[i];
        m[i][2] = -axes.forward[i];
    }
    m[3] = glm::dvec4(-glm::dot(axes.right, eye), -glm::dot(axes.up, eye), glm::dot(axes.forward, eye), 1);
    return m;
}

glm::dmat4 projection(const Camera& camera, int width, int height) {
    const double aspect = static_cast<double>(width) / static_cast<double>(height);
    const auto zNear = static_cast<double>(camera.zNear), zFar = static_cast<double>(camera.zFar);
    if (camera.isOrthographic()) {
        const double y = 0.5 * static_cast<double>(camera.orthographicHeight), x = y * aspect;
        return glm::ortho(-x, x, -y, y, zNear, zFar);
    }
    return glm::perspective(static_cast<double>(camera.fovY), aspect, zNear, zFar);
}

}  // namespace

void requireUsable(const Camera& camera) {
    for (const glm::vec3& v : {camera.eye, camera.target, camera.up})
        if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z))
            base::fail(ErrorKind::Usage, "camera: eye, target or up is not finite");
    if (!(camera.fovY > 0 && camera.fovY < std::numbers::pi_v<float>))
        base::fail(ErrorKind::Usage, "camera: a field of view of %g; above 0 and below pi would be right",
                   static_cast<double>(camera.fovY));
    if (!(camera.orthographicHeight >= 0 && std::isfinite(camera.orthographicHeight)))
        base::fail(ErrorKind::Usage, "camera: an orthographic height of %g; above 0, or 0, would be right",
                   static_cast<double>(camera.orthographicHeight));
    if (!(camera.zNear > 0 && camera.zNear < camera.zFar && std::isfinite(camera.zFar)))
        base::fail(ErrorKind::Usage, "camera: near %g, far %g; 0 < near < far would be right",
                   static_cast<double>(camera.zNear), static_cast<double>(camera.zFar));
    if (!std::isfinite(camera.lensDiameter) || !std::isfinite(camera.focusDistance))
        base::fail(ErrorKind::Usage, "camera: its lens is not finite");
}

glm::mat4 viewFromWorld(const Camera& camera) { return glm::mat4(viewMatrix(camera)); }

glm::mat4 clipFromView(const Camera& camera, int width, int height) {
    return glm::mat4(projection(camera, width, height));
}

PixelPart pixelPart(int index, int count) {
    // The step next to the golden section of the count that meets every row: such lattices have few gaps.
    int step = std::max(static_cast<int>(std::lround(0.618 * count)), 1);
    while (std::gcd(step, count) != 1) ++step;
    const double row = static_cast<double>(index) * step;
    const double x = (index + 0.5) / count, y = (std::fmod(row, count) + 0.5) / count;
    // Thresholds of blended surfaces are even over the views, in an order apart from that of the places.
    int leap = std::max(static_cast<int>(std::lround(0.382 * count)), 1);
    while (std::gcd(leap, count) != 1) ++leap;
    const float turn = static_cast<float>(index * leap % count) / static_cast<float>(count);
    return {{x - 0.5, y - 0.5}, static_cast<float>(1 / std::sqrt(static_cast<double>(count))), turn};
}

namespace {

// Element `index` of a sequence in one dimension that steps by `step`: as even as any, when `step` is badly
// approximated by fractions.
double stepped(int index, double start, double step) {
    const double place = start + index * step;
    return place - std::floor(place);
}

// Inverse powers of the root of x^5 = x + 1: steps of the sequence in four dimensions of Roberts 2018, "The
// Unreasonable Effectiveness of Quasirandom Sequences".
constexpr double kStep[4] = {0.85667488385450290, 0.73389185662712600, 0.62870672103780860,
                             0.53859725722361000};

}  // namespace

glm::dvec2 lensPoint(int index) {
    return math::discFromSquare({stepped(index, 0.5, kStep[2]), stepped(index, 0.5, kStep[3])});
}

PixelPart pixelPartOfFrame(int frame) {
    if (frame == 0) return {};
    // Textures as sharp as a quarter of a pixel's area asks for: what is added up makes them even.
    constexpr float kFootprint = 0.5f;
    const float turn = static_cast<float>(stepped(frame, 0.5, 0.61803398874989485));
    return {.offset = {stepped(frame, 0.5, kStep[0]) - 0.5, stepped(frame, 0.5, kStep[1]) - 0.5},
            .footprint = kFootprint,
            .blending = turn,
            .lens = lensPoint(frame)};
}

PixelPart centersOfStill() { return {.blending = 2.0f}; }

gpu::FrameConstants frameConstants(const Camera& camera, int width, int height, const PixelPart& part) {
    const CameraAxes axes = cameraAxes(camera);
    const bool parallel = camera.isOrthographic();
    // Tangents, of parallel rays half the picture's size
    const double tanY = parallel ? 0.5 * static_cast<double>(camera.orthographicHeight)
                                 : std::tan(0.5 * static_cast<double>(camera.fovY));
    const double tanX = tanY * static_cast<double>(width) / static_cast<double>(height);
    gpu::FrameConstants frame{};
    glm::dvec2 shift = 2.0 * part.offset / glm::dvec2(width, height);  // in clip space
    // Another point of the lens sees the plane in focus where the middle sees it.
    glm::dvec2 besideEye(0);
    const double focus = static_cast<double>(camera.focus());
    if (camera.hasLens()) {
        besideEye = 0.5 * static_cast<double>(camera.lensDiameter) * part.lens;
        shift -= besideEye / (focus * glm::dvec2(tanX, tanY));
    }
    const glm::dmat4 lens = projection(camera, width, height);
    // Points are divided by w after the shift.
    glm::dmat4 shifted = lens;
    for (int i = 0; i < 4; ++i) {
        shifted[i].x -= shift.x * lens[i].w;
        shifted[i].y -= shift.y * lens[i].w;
    }
    glm::dmat4 view = viewMatrix(camera);
    view[3].x -= besideEye.x;
    view[3].y -= besideEye.y;
    frame.clipFromWorld = glm::mat4(shifted * view);
    const glm::dvec3 aside = axes.right * (shift.x * tanX) + axes.up * (shift.y * tanY);
    frame.eye = glm::vec3(glm::dvec3(camera.eye) + axes.right * besideEye.x + axes.up * besideEye.y +
                          (parallel ? aside : glm::dvec3(0)));
    frame.viewForward = glm::vec3(axes.forward + (parallel ? glm::dvec3(0) : aside));
    frame.viewRight = glm::vec3(axes.right * tanX);
    frame.viewUp = glm::vec3(axes.up * tanY);
    frame.footprint = part.footprint;
    frame.blending = part.blending;
    frame.parallel = parallel ? 1.0f : 0.0f;
    frame.width = static_cast<std::uint32_t>(width);
    frame.height = static_cast<std::uint32_t>(height);
    return frame;
}

}  // namespace conelight::view
