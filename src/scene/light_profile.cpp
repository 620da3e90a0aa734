// SPDX-License-Identifier: MIT
// What a light's profile says: a factor by direction, and the mean of that over all directions.
#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "conelight/scene.h"
#include "scene/light_profile.h"

namespace conelight {
namespace {

constexpr int kRows = LightProfile::kRows, kColumns = LightProfile::kColumns;

float at(const LightProfile& profile, int column, int row) {
    return profile.factors[static_cast<std::size_t>(row * kColumns + column)];
}

}  // namespace

scene::ProfileFrame scene::profileFrame(const Light& light) {
    ProfileFrame axes;
    const float length = glm::length(light.direction);
    axes.direction = length > 0 ? light.direction / length : glm::vec3(0, -1, 0);
    glm::vec3 u = light.halfU - glm::dot(light.halfU, axes.direction) * axes.direction;
    if (!(glm::length(u) > 1e-4f * glm::length(light.halfU))) {
        const glm::vec3 other = std::abs(axes.direction.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
        u = glm::cross(other, axes.direction);
    }
    axes.u = glm::normalize(u);
    axes.v = glm::cross(axes.direction, axes.u);
    return axes;
}

float intensityFactor(const Light& light, const glm::vec3& away) {
    if (light.profile == nullptr) return 1;
    const scene::ProfileFrame axes = scene::profileFrame(light);
    const float cosine = glm::clamp(glm::dot(away, axes.direction), -1.0f, 1.0f);
    const float about =
        std::atan2(-glm::dot(away, axes.v), glm::dot(away, axes.u)) * (0.5f / glm::pi<float>());
    const glm::vec2 place((about - std::floor(about)) * kColumns,
                          std::acos(cosine) * ((kRows - 1) / glm::pi<float>()));
    const int column = std::min(static_cast<int>(place.x), kColumns - 1);
    const int row = std::min(static_cast<int>(place.y), kRows - 2);
    const glm::vec2 part = place - glm::vec2(column, row);
    const int next = column + 1 < kColumns ? column + 1 : 0;
    return glm::mix(glm::mix(at(*light.profile, column, row), at(*light.profile, next, row), part.x),
                    glm::mix(at(*light.profile, column, row + 1), at(*light.profile, next, row + 1), part.x),
                    part.y);
}

float scene::profileFlux(const Light& light, float cosInner, float cosOuter) {
    double sum = 0;
    for (int row = 0; row < kRows; ++row) {
        double mean = 0;
        for (int column = 0; column < kColumns; ++column)
            mean += double(at(*light.profile, column, row)) / kColumns;
        // Trapezoids of half a degree.
        const double angle = glm::pi<double>() * row / (kRows - 1);
        const double t = std::clamp(
            (std::cos(angle) - double(cosOuter)) / std::max(double(cosInner - cosOuter), 1e-3), 0.0, 1.0);
        sum += mean * t * t * std::sin(angle);
    }
    return static_cast<float>(2 * glm::pi<double>() * sum * glm::pi<double>() / (kRows - 1));
}

}  // namespace conelight
