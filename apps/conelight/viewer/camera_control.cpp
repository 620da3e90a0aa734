// SPDX-License-Identifier: MIT
#include "viewer/camera_control.h"

#include <algorithm>
#include <cmath>

namespace conelight::program {
namespace {

constexpr glm::vec3 kUp{0, 1, 0};

glm::vec3 rightOf(const glm::vec3& forward) {
    const glm::vec3 right = glm::cross(forward, kUp);
    const float length = glm::length(right);
    return length > 1e-6f ? right / length : glm::vec3(1, 0, 0);
}

ViewAngles turned(ViewAngles angles, const glm::vec2& turn) {
    angles.yaw += turn.x;
    angles.pitch = std::clamp(angles.pitch + turn.y, -kMaxPitch, kMaxPitch);
    return angles;
}

}  // namespace

ViewAngles viewAngles(const Camera& camera) {
    const glm::vec3 d = camera.target - camera.eye;
    const float length = glm::length(d);
    if (!(length > 0)) return {};
    return {std::atan2(-d.x, -d.z), std::asin(std::clamp(d.y / length, -1.0f, 1.0f))};
}

glm::vec3 viewDirection(const ViewAngles& angles) {
    const float flat = std::cos(angles.pitch);
    return {-std::sin(angles.yaw) * flat, std::sin(angles.pitch), -std::cos(angles.yaw) * flat};
}

void fly(Camera& camera, const FlyInput& input) {
    const float distance = std::max(glm::length(camera.target - camera.eye), 1e-6f);
    const glm::vec3 forward = viewDirection(turned(viewAngles(camera), input.turn));
    const glm::vec3 step = rightOf(forward) * input.move.x + kUp * input.move.y + forward * input.move.z;
    const float length = glm::length(step);
    if (length > 0) camera.eye += step / std::max(length, 1.0f) * (input.speed * input.seconds);
    camera.target = camera.eye + forward * distance;
    camera.up = kUp;
}

void orbit(Camera& camera, const glm::vec2& turn) {
    const float distance = glm::length(camera.target - camera.eye);
    camera.eye = camera.target - viewDirection(turned(viewAngles(camera), turn)) * distance;
    camera.up = kUp;
}

void pan(Camera& camera, const glm::vec2& pixels, int height) {
    const glm::vec3 forward = glm::normalize(camera.target - camera.eye);
    const glm::vec3 right = rightOf(forward);
    const glm::vec3 up = glm::cross(right, forward);
    const float distance = glm::length(camera.target - camera.eye);
    const float metresPerPixel =
        2 * distance * std::tan(0.5f * camera.fovY) / static_cast<float>(std::max(height, 1));
    const glm::vec3 step = (up * pixels.y - right * pixels.x) * metresPerPixel;
    camera.eye += step;
    camera.target += step;
}

void dolly(Camera& camera, float factor) {
    camera.eye = camera.target + (camera.eye - camera.target) * std::clamp(factor, 0.01f, 100.0f);
}

void focusOn(Camera& camera, const Aabb& bounds, float aspect) {
    if (bounds.empty()) return;
    const float radius = std::max(0.5f * glm::length(bounds.extent()), 1e-4f);
    // The sphere round the box inside the narrower of the two angles.
    const float halfY = 0.5f * camera.fovY;
    const float half = aspect < 1 ? std::atan(std::tan(halfY) * aspect) : halfY;
    const glm::vec3 forward = viewDirection(viewAngles(camera));
    camera.target = bounds.center();
    camera.eye = camera.target - forward * (radius / std::sin(half));
}

float flySpeed(const Aabb& bounds) {
    const glm::vec3 extent = bounds.extent();
    return std::max(0.25f * std::max({extent.x, extent.y, extent.z}), 1e-3f);
}

}  // namespace conelight::program
