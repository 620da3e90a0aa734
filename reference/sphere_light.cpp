// SPDX-License-Identifier: MIT
#include "reference/sphere_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "reference/materials.h"

namespace conelight::reference {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

// Where a ray that has come `along` m past the sphere's middle, `aside2` m^2 beside it, meets its front.
void meet(const SphereShape& sphere, const glm::vec3& from, float along, float aside2, LightSample& result) {
    result.distance = along - std::sqrt(std::max(sphere.radius * sphere.radius - aside2, 0.0f));
    const glm::vec3 point = from + result.distance * result.toLight;
    result.target = RayScene::offsetOrigin(point, glm::normalize(point - sphere.center));
}

// 1 - the cosine of half the angle under which the sphere is seen, exact for small ones.
float heightOf(float sine2) { return sine2 / (1 + std::sqrt(1 - sine2)); }

}  // namespace

bool sampleSphere(const SphereShape& sphere, const glm::vec3& from, const glm::vec2& u, LightSample& result) {
    const glm::vec3 way = sphere.center - from;
    const float d2 = glm::dot(way, way), r2 = sphere.radius * sphere.radius;
    if (!(d2 > r2) || !(r2 > 0)) return false;
    const float whole = heightOf(r2 / d2), height = u.x * whole;
    const float cosine = 1 - height, sine2 = height * (2 - height), phi = 2 * kPi * u.y;
    const float sine = std::sqrt(sine2);
    result.toLight = glm::normalize(
        Frame(way / std::sqrt(d2)).toWorld({sine * std::cos(phi), sine * std::sin(phi), cosine}));
    result.density = 1 / (2 * kPi * whole);
    meet(sphere, from, std::sqrt(d2) * cosine, d2 * sine2, result);
    return true;
}

bool sphereAlong(const SphereShape& sphere, const glm::vec3& from, const glm::vec3& direction,
                 LightSample& result) {
    const glm::vec3 way = sphere.center - from;
    const float d2 = glm::dot(way, way), r2 = sphere.radius * sphere.radius;
    const float along = glm::dot(way, direction);
    const glm::vec3 aside = way - along * direction;
    const float aside2 = glm::dot(aside, aside);
    if (!(d2 > r2) || !(along > 0) || !(aside2 < r2)) return false;
    result.toLight = direction;
    result.density = 1 / (2 * kPi * heightOf(r2 / d2));
    meet(sphere, from, along, aside2, result);
    return true;
}

}  // namespace conelight::reference
