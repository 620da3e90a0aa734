// SPDX-License-Identifier: MIT
// The thesis's sets of diffuse cones as they lie about a surface's normal: front, four at 45 degrees, four
// along the surface, lifted by half their aperture (docs/guide/thesis_mode.md).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "figures/drawings/drawings.h"
#include "figures/drawings/space_view.h"

namespace conelight::figures {
namespace {

using glm::dvec3;

struct ConeShape {
    dvec3 axis;
    const char* tint;
};

// A cone of length 1: its mantle as seen, and its mouth.
void drawCone(Drawing& d, const SpaceView& view, const ConeShape& cone, double half) {
    const dvec3 u =
        glm::normalize(glm::cross(cone.axis, std::abs(cone.axis.z) < 0.9 ? dvec3(0, 0, 1) : dvec3(1, 0, 0)));
    const dvec3 v = glm::cross(cone.axis, u);
    std::vector<dvec3> mouth;
    for (int i = 0; i < 48; ++i) {
        const double a = 2 * kPi * i / 48;
        mouth.push_back(std::cos(half) * cone.axis + std::sin(half) * (std::cos(a) * u + std::sin(a) * v));
    }
    // The outline: the mouth's points that lie furthest to either side of the axis, as seen.
    const Point tip = view.at(dvec3(0)), along = glm::normalize(view.at(cone.axis) - tip + Point(1e-9, 0));
    const auto angle = [&](const dvec3& p) {
        const Point q = view.at(p) - tip;
        return std::atan2(along.x * q.y - along.y * q.x, glm::dot(along, q));
    };
    const auto [low, high] = std::minmax_element(
        mouth.begin(), mouth.end(), [&](const dvec3& a, const dvec3& b) { return angle(a) < angle(b); });
    d.polygon({tip, view.at(*low), view.at(*high)}, {.stroke = "none", .fill = cone.tint, .opacity = 0.35});
    d.polygon(view.outline(mouth), {.stroke = cone.tint, .width = 1.4, .fill = cone.tint, .opacity = 0.55});
    d.line(tip, view.at(*low), stroke(cone.tint, 1.4));
    d.line(tip, view.at(*high), stroke(cone.tint, 1.4));
}

}  // namespace

std::string drawConeSet(bool side, bool intermediate) {
    Drawing d;
    const SpaceView view{.scale = 150, .azimuthDeg = 25, .elevationDeg = 24};
    const int count = 1 + (side ? 4 : 0) + (intermediate ? 4 : 0);
    // Cones share the hemisphere: cos(a/2) = 1 - 1/m; one alone takes at most 60 degrees to each side.
    const double half = std::acos(count > 1 ? 1 - 1.0 / count : 0.5), lift = std::sin(half);
    std::vector<ConeShape> cones{{{0, 0, 1}, colour::kRed}};
    for (int k = 0; k < 4; ++k) {
        const dvec3 across(std::cos(0.5 * kPi * k), std::sin(0.5 * kPi * k), 0);
        if (side) cones.push_back({across * std::sqrt(1 - lift * lift) + dvec3(0, 0, lift), colour::kGreen});
        if (intermediate) cones.push_back({glm::normalize(across + dvec3(0, 0, 1)), colour::kBlue});
    }
    std::stable_sort(cones.begin(), cones.end(), [&](const ConeShape& a, const ConeShape& b) {
        return view.depth(a.axis) < view.depth(b.axis);
    });
    std::vector<dvec3> ground;
    for (int i = 0; i < 64; ++i)
        ground.push_back({std::cos(2 * kPi * i / 64), std::sin(2 * kPi * i / 64), 0});
    d.polygon(view.outline(ground), {.stroke = colour::kPale, .width = 1, .fill = colour::kWash});
    for (const ConeShape& cone : cones) drawCone(d, view, cone, half);
    d.text({0, 96}, fmt::format("{} cone{}, aperture {:.2f} rad", count, count > 1 ? "s" : "", 2 * half),
           {.size = 15});
    return d.svg("A set of diffuse cones about the normal");
}

}  // namespace conelight::figures
