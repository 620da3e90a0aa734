// SPDX-License-Identifier: MIT
#include "figures/drawings/space_view.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace conelight::figures {
namespace {
double radians(double degrees) { return degrees * std::numbers::pi / 180; }
}  // namespace

glm::dvec3 SpaceView::toEye() const {
    const double a = radians(azimuthDeg), e = radians(elevationDeg);
    return {std::cos(a) * std::cos(e), std::sin(a) * std::cos(e), std::sin(e)};
}

Point SpaceView::at(const glm::dvec3& p) const {
    const double a = radians(azimuthDeg), e = radians(elevationDeg);
    const double right = -std::sin(a) * p.x + std::cos(a) * p.y;
    const double up = -std::sin(e) * (std::cos(a) * p.x + std::sin(a) * p.y) + std::cos(e) * p.z;
    return origin + scale * Point(right, -up);
}

std::vector<Point> SpaceView::outline(const std::vector<glm::dvec3>& points) const {
    std::vector<Point> all;
    for (const glm::dvec3& p : points) all.push_back(at(p));
    return all;
}

double SpaceView::depth(const glm::dvec3& p) const { return glm::dot(p, toEye()); }

std::string hexColour(const glm::dvec3& rgb) {
    const glm::ivec3 c(glm::round(glm::clamp(rgb, 0.0, 1.0) * 255.0));
    return fmt::format("#{:02x}{:02x}{:02x}", c.r, c.g, c.b);
}

void drawCube(Drawing& drawing, const SpaceView& view, const glm::dvec3& corner, double size,
              const glm::dvec3& rgb, glm::bvec3 open) {
    const glm::dvec3 eye = view.toEye();
    constexpr double kShade[3] = {0.80, 0.66, 1.0};  // by eye: three sides that differ
    for (int axis = 0; axis < 3; ++axis) {
        if (!open[axis]) continue;
        glm::dvec3 base = corner, u(0), v(0);
        if (eye[axis] > 0) base[axis] += size;
        u[(axis + 1) % 3] = size;
        v[(axis + 2) % 3] = size;
        drawing.polygon(
            view.outline({base, base + u, base + u + v, base + v}),
            {.stroke = hexColour(rgb * 0.45), .width = 0.6, .fill = hexColour(rgb * kShade[axis])});
    }
}

}  // namespace conelight::figures
