// SPDX-License-Identifier: MIT
// Points of a disc from points of a square.
#pragma once

#include <cmath>
#include <glm/glm.hpp>

namespace conelight::math {

// [0,1]^2 -> the unit disc, areas kept, the middle to the middle (Shirley and Chiu 1997, "A Low Distortion Map Between
// Disk and Square").
inline glm::dvec2 discFromSquare(const glm::dvec2& square) {
    const glm::dvec2 p = 2.0 * square - 1.0;
    if (p.x == 0 && p.y == 0) return glm::dvec2(0);
    constexpr double kEighth = 0.78539816339744831;  // of a turn, rad
    const bool wide = std::abs(p.x) > std::abs(p.y);
    const double radius = wide ? p.x : p.y;
    const double angle = wide ? kEighth * (p.y / p.x) : kEighth * (2 - p.x / p.y);
    return radius * glm::dvec2(std::cos(angle), std::sin(angle));
}

}  // namespace conelight::math
