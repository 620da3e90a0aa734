// SPDX-License-Identifier: MIT
#include "viewer/camera_control.h"

#include <algorithm>
#include <cmath>

#include "session/lens_range.h"
#include "session/projection.h"

namespace conelight::program {
namespace {

constexpr glm::vec3 kUp{0, 1, 0};

glm::vec3 rightOf(const glm::vec3& forward, const glm::vec3& up) {
    const glm::vec3 right = glm::cross(forward, up);
    const float length = glm::length(right);
    if (length > 1e-6f) return right / length;
    return up == kUp ? glm::vec3(1, 0, 0) : glm::normalize(glm::cross(up, glm::vec3(up.y, up.z, -up.x)));
}

// What yaw and pitch are measured by: yaw 0 and pitch 0 look along `ahead`. Unit vectors, right-handed.
struct TurnAxes {
    glm::vec3 right{1, 0, 0}, up = kUp, ahead{0, 0, -1};
};

TurnAxes axesAbout(const glm::vec3& up) {
    if (up == kUp) return {};
    TurnAxes axes;
    axes.up = up;
    axes.right = rightOf(std::fabs(up.z) < 0.9f ? glm::vec3(0, 0, -1) : glm::vec3(0, 1, 0), up);
    axes.ahead = glm::cross(up, axes.right);
    return axes;
}

ViewAngles anglesIn(const TurnAxes& axes, const glm::vec3& way) {
    const float length = glm::length(way);
    if (!(length > 0)) return {};
    return {std::atan2(-glm::dot(way, axes.right), glm::dot(way, axes.ahead)),
            std::asin(std::clamp(glm::dot(way, axes.up) / length, -1.0f, 1.0f))};
}

// Straight up or down the upper edge of the picture says where ahead is.
ViewAngles anglesOf(const TurnAxes& axes, const Camera& camera) {
    const glm::vec3 way = camera.target - camera.eye;
    ViewAngles angles = anglesIn(axes, way);
    const float along = glm::dot(way, axes.up);
    if (glm::length(way - along * axes.up) > 1e-5f * glm::length(way)) return angles;
    const glm::vec3 upper(cameraAxes(camera).up);
    angles.yaw = anglesIn(axes, along < 0 ? upper : -upper).yaw;
    return angles;
}

glm::vec3 directionIn(const TurnAxes& axes, const ViewAngles& angles) {
    const float flat = std::cos(angles.pitch);
    return axes.ahead * (std::cos(angles.yaw) * flat) - axes.right * (std::sin(angles.yaw) * flat) +
           axes.up * std::sin(angles.pitch);
}

ViewAngles turned(ViewAngles angles, const glm::vec2& turn) {
    angles.yaw += turn.x;
    angles.pitch = std::clamp(angles.pitch + turn.y, -kMaxPitch, kMaxPitch);
    return angles;
}

}  // namespace

ViewAngles viewAngles(const Camera& camera) { return anglesIn({}, camera.target - camera.eye); }

glm::vec3 viewDirection(const ViewAngles& angles) { return directionIn({}, angles); }

glm::vec3 turnAxis(const Camera& camera) {
    constexpr float kLevel = 1e-3f;  // sine of a roll that is none: rounding in files, not meant
    const float length = glm::length(camera.up);
    if (!(length > 0)) return kUp;
    const glm::vec3 up = camera.up / length, view = camera.target - camera.eye;
    const float slant = glm::length(glm::cross(view, kUp));
    if (!(slant > kLevel * glm::length(view))) return kUp;  // straight up or down: the roll says nothing
    const glm::vec3 right = glm::cross(view, up);
    const bool level = std::fabs(right.y) <= kLevel * std::max(glm::length(right), 1e-20f);
    return level && up.y > kLevel ? kUp : up;
}

void fly(Camera& camera, const FlyInput& input) {
    const float distance = std::max(glm::length(camera.target - camera.eye), 1e-6f);
    const TurnAxes axes = axesAbout(turnAxis(camera));
    const ViewAngles angles = anglesOf(axes, camera);
    const glm::vec3 forward = directionIn(axes, turned(angles, input.turn));
    const glm::vec3 step =
        rightOf(forward, axes.up) * input.move.x + axes.up * input.move.y + forward * input.move.z;
    const float length = glm::length(step);
    if (length > 0) camera.eye += step / std::max(length, 1.0f) * (input.speed * input.seconds);
    camera.target = camera.eye + forward * distance;
    camera.up = axes.up;
}

void orbit(Camera& camera, const glm::vec2& turn) {
    const float distance = glm::length(camera.target - camera.eye);
    const TurnAxes axes = axesAbout(turnAxis(camera));
    const ViewAngles angles = anglesOf(axes, camera);
    camera.eye = camera.target - directionIn(axes, turned(angles, turn)) * distance;
    camera.up = axes.up;
}

void pan(Camera& camera, const glm::vec2& pixels, int height) {
    const CameraAxes axes = cameraAxes(camera);
    const float distance = glm::length(camera.target - camera.eye);
    const float metresPerPixel = camera.heightAt(distance) / static_cast<float>(std::max(height, 1));
    const glm::vec3 step =
        (glm::vec3(axes.up) * pixels.y - glm::vec3(axes.right) * pixels.x) * metresPerPixel;
    camera.eye += step;
    camera.target += step;
}

void dolly(Camera& camera, float factor) {
    factor = std::clamp(factor, 0.01f, 100.0f);
    if (camera.isOrthographic()) {
        camera.orthographicHeight = std::clamp(factor * camera.orthographicHeight, kLeastView, kTallestView);
        const float distance = glm::distance(camera.eye, camera.target);
        factor = std::max(apparentDistance(camera) / std::max(distance, 1e-6f), 1.0f);
    }
    camera.eye = camera.target + (camera.eye - camera.target) * factor;
}

void focusOn(Camera& camera, const Aabb& bounds, float aspect) {
    if (bounds.empty()) return;
    const float radius = std::max(0.5f * glm::length(bounds.extent()), 1e-4f);
    // The sphere round the box inside the narrower of the two angles.
    const float halfY = 0.5f * camera.fovY;
    const float half = aspect < 1 ? std::atan(std::tan(halfY) * aspect) : halfY;
    const glm::vec3 forward(cameraAxes(camera).forward);
    camera.target = bounds.center();
    camera.eye = camera.target - forward * (radius / std::sin(half));
    if (camera.isOrthographic())
        camera.orthographicHeight = std::min(2 * radius / std::min(aspect, 1.0f), kTallestView);
}

float flySpeed(const Aabb& bounds) {
    const glm::vec3 extent = bounds.extent();
    return std::max(0.25f * std::max({extent.x, extent.y, extent.z}), 1e-3f);
}

}  // namespace conelight::program
