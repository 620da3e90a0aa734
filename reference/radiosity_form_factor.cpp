// SPDX-License-Identifier: MIT
#include "reference/radiosity_form_factor.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace conelight::reference {

double polygonFormFactor(const glm::dvec3& point, const glm::dvec3& normal,
                         std::span<const glm::dvec3> corners) {
    constexpr double kTwoPi = 6.283185307179586;
    // A plane cuts a convex polygon of n corners to at most n + 1.
    std::array<glm::dvec3, kMostCorners + 1> clipped;
    std::size_t count = 0;
    const std::size_t n = std::min(corners.size(), kMostCorners);
    for (std::size_t i = 0; i < n; ++i) {
        const glm::dvec3 a = corners[i] - point, b = corners[(i + 1) % n] - point;
        const double ha = glm::dot(a, normal), hb = glm::dot(b, normal);
        if (ha >= 0 && count < clipped.size()) clipped[count++] = a;
        if ((ha >= 0) != (hb >= 0) && count < clipped.size())
            clipped[count++] = a + (b - a) * (ha / (ha - hb));
    }
    if (count < 3) return 0;
    // Each edge gives the angle it spans times the cosine between its plane and the receiver's normal.
    double sum = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const glm::dvec3 &a = clipped[i], &b = clipped[(i + 1) % count];
        const glm::dvec3 cross = glm::cross(a, b);
        const double length = glm::length(cross);
        if (length > 0) sum += std::atan2(length, glm::dot(a, b)) * glm::dot(cross, normal) / length;
    }
    return std::clamp(std::fabs(sum) / kTwoPi, 0.0, 1.0);
}

}  // namespace conelight::reference
