// SPDX-License-Identifier: MIT
#include "reference/frame.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>

namespace conelight::reference {

Frame::Frame(const glm::vec3& normal) : n(normal) {
    const float sign = std::copysign(1.0f, n.z);
    const float a = -1.0f / (sign + n.z);
    const float b = n.x * n.y * a;
    u = {1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x};
    w = {b, sign + n.y * n.y * a, -n.y};
}

glm::vec3 aboveHorizon(const glm::vec3& toEye) {
    return toEye.z >= kMinNoV
               ? toEye
               : glm::normalize(glm::vec3(toEye.x, toEye.y, kMinNoV) + glm::vec3(1e-12f, 0, 0));
}

// 1 - NoH^2 comes from the lateral parts, which keeps its digits at the peak of smooth surfaces.
float ggx(float alpha2, const glm::vec3& h) {
    const float d = h.x * h.x + h.y * h.y + h.z * h.z * alpha2;
    return alpha2 / (glm::pi<float>() * d * d);
}

float ggxTimesCosine(float alpha, const glm::vec3& h, float NoL, float NoV) {
    const float alpha2 = alpha * alpha, cosine = std::max(NoL, kMinNoV);
    const float smith = cosine * std::sqrt(NoV * NoV * (1 - alpha2) + alpha2) +
                        NoV * std::sqrt(cosine * cosine * (1 - alpha2) + alpha2);
    return ggx(alpha2, h) * 0.5f / std::max(smith, 1e-7f) * NoL;
}

float visibleDensity(float alpha2, float distribution, float NoV) {
    return distribution * 0.5f / (NoV + std::sqrt(alpha2 + (1 - alpha2) * NoV * NoV));
}

glm::vec3 sampleVisibleNormal(const glm::vec3& toEye, float alpha, const glm::vec2& u) {
    // The view in the space where the surface is a unit sphere; a uniform cap of reflected directions there.
    const glm::vec3 v = glm::normalize(glm::vec3(alpha * toEye.x, alpha * toEye.y, toEye.z));
    const float phi = 2 * glm::pi<float>() * u.x;
    const float z = (1 - u.y) * (1 + v.z) - v.z;
    const float sine = std::sqrt(std::clamp(1 - z * z, 0.0f, 1.0f));
    const glm::vec3 h = glm::vec3(sine * std::cos(phi), sine * std::sin(phi), z) + v;
    return glm::normalize(glm::vec3(alpha * h.x, alpha * h.y, std::max(h.z, 1e-12f)));
}

}  // namespace conelight::reference
