// SPDX-License-Identifier: MIT
// The generated studio as a picture of surroundings: an even room with soft rectangles of light.
#include "conelight/studio.h"

#include <cmath>

namespace conelight {
namespace {

constexpr int kStudioColumns = 512;  // 0.7 degrees: edges of lamps are softer

// 1 on a rectangle about a direction, falling to 0 over the edge; sizes are tangents.
double softbox(const glm::dvec3& d, const glm::dvec3& axis, double halfWidth, double halfHeight) {
    const glm::dvec3 n = glm::normalize(axis);
    const glm::dvec3 right = glm::normalize(glm::cross(n, glm::dvec3(0, 1, 0))), up = glm::cross(right, n);
    const double ahead = glm::dot(d, n);
    if (ahead <= 0) return 0;
    constexpr double kEdge = 0.06;
    const auto inside = [&](double at, double half) {
        return 1 - glm::smoothstep(half - kEdge, half + kEdge, std::fabs(at) / ahead);
    };
    return inside(glm::dot(d, right), halfWidth) * inside(glm::dot(d, up), halfHeight);
}

double studioRadiance(const StudioLevels& levels, const glm::dvec3& d) {
    // Lighter above, darker below: an even room hides the shape of what stands in it.
    double room = levels.room * (0.75 + 0.5 * glm::smoothstep(-0.6, 0.9, d.y));
    if (levels.floor > 0) {
        if (d.y <= 0) return levels.floor;
        room = glm::mix(levels.floor, room, glm::smoothstep(0.0, 0.6, d.y));
    }
    const double key = levels.key * softbox(d, {-0.75, 0.85, 0.9}, 0.55, 0.45);
    const double fill =
        levels.fill * (softbox(d, {1.0, 0.35, 0.55}, 0.35, 0.7) + softbox(d, {0.35, 1.0, -1.0}, 0.8, 0.25));
    return room + key + fill;
}

}  // namespace

std::shared_ptr<const EnvironmentImage> studioPicture(const StudioLevels& levels) {
    auto image = std::make_shared<EnvironmentImage>();
    image->width = kStudioColumns;
    image->height = kStudioColumns / 2;
    for (int y = 0; y < image->height; ++y)
        for (int x = 0; x < image->width; ++x) {
            const glm::vec2 uv((static_cast<float>(x) + 0.5f) / static_cast<float>(image->width),
                               (static_cast<float>(y) + 0.5f) / static_cast<float>(image->height));
            image->radiance.emplace_back(
                glm::vec3(glm::dvec3(studioRadiance(levels, glm::dvec3(environmentDirection(uv))))));
        }
    return image;
}

}  // namespace conelight
