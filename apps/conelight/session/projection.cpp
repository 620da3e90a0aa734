// SPDX-License-Identifier: MIT
#include "session/projection.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "session/lens_range.h"

namespace conelight::program {

ViewRay viewRay(const Camera& camera, float aspect, const glm::vec2& ndc) {
    const CameraAxes axes = cameraAxes(camera);
    const double half = camera.isOrthographic() ? 0.5 * static_cast<double>(camera.orthographicHeight)
                                                : std::tan(0.5 * static_cast<double>(camera.fovY));
    const glm::dvec3 aside = half * (static_cast<double>(ndc.x) * double(aspect) * axes.right +
                                     static_cast<double>(ndc.y) * axes.up);
    if (camera.isOrthographic())
        return {glm::vec3(glm::dvec3(camera.eye) + aside), glm::vec3(axes.forward), 1};
    const glm::dvec3 way = axes.forward + aside;
    return {camera.eye, glm::vec3(glm::normalize(way)), static_cast<float>(glm::length(way))};
}

ViewRay viewRayTo(const Camera& camera, const glm::vec3& point) {
    const glm::dvec3 forward = cameraAxes(camera).forward, way = glm::dvec3(point) - glm::dvec3(camera.eye);
    const double depth = glm::dot(way, forward);
    if (camera.isOrthographic())
        return {glm::vec3(glm::dvec3(point) - depth * forward), glm::vec3(forward), 1};
    const double distance = std::max(glm::length(way), 1e-30);
    return {camera.eye, glm::vec3(way / distance), static_cast<float>(distance / std::max(depth, 1e-30))};
}

std::string projectionText(const Camera& camera) {
    if (camera.isOrthographic()) return fmt::format("orthographic {:.4g} m", camera.orthographicHeight);
    return fmt::format("fov {:.4g} deg", glm::degrees(camera.fovY));
}

float apparentDistance(const Camera& camera) {
    if (!camera.isOrthographic()) return glm::distance(camera.eye, camera.target);
    return 0.5f * camera.orthographicHeight / std::tan(0.5f * camera.fovY);
}

void switchProjection(Camera& camera) {
    if (camera.isOrthographic()) {
        const glm::dvec3 forward = cameraAxes(camera).forward;
        const auto distance = static_cast<double>(apparentDistance(camera));
        camera.eye = glm::vec3(glm::dvec3(camera.target) - distance * forward);
        camera.orthographicHeight = 0;
    } else {
        const float height = camera.heightAt(glm::distance(camera.eye, camera.target));
        camera.orthographicHeight = std::clamp(height, kLeastView, kTallestView);
    }
}

}  // namespace conelight::program
