// SPDX-License-Identifier: MIT
#include "reference/materials.h"

#include <algorithm>
#include <cmath>

namespace conelight::reference {
namespace {

constexpr float kPi = 3.14159265358979f;
constexpr float kMinNoV = 1e-4f;  // as math::makeBrdf clamps it
// Neither part is sampled more rarely than this while it reflects at all: its albedo says little about how
// much light it meets.
constexpr float kLeastShare = 0.1f;

float luminance(const glm::vec3& c) { return 0.2126f * c.r + 0.7152f * c.g + 0.0722f * c.b; }

// D of GGX at a local half vector. 1 - NoH^2 comes from the lateral parts, which keeps its digits at the peak
// of smooth surfaces.
float ggx(float alpha2, const glm::vec3& h) {
    const float d = h.x * h.x + h.y * h.y + h.z * h.z * alpha2;
    return alpha2 / (kPi * d * d);
}

// Density of reflected directions when visible normals are sampled: G1 D / (4 NoV).
float visibleDensity(float alpha2, float distribution, float NoV) {
    return distribution * 0.5f / (NoV + std::sqrt(alpha2 + (1 - alpha2) * NoV * NoV));
}

glm::vec3 sampleVisibleNormal(const glm::vec3& toEye, float alpha, const glm::vec2& u) {
    // The view in the space where the surface is a unit sphere; a uniform cap of reflected directions there.
    const glm::vec3 v = glm::normalize(glm::vec3(alpha * toEye.x, alpha * toEye.y, toEye.z));
    const float phi = 2 * kPi * u.x;
    const float z = (1 - u.y) * (1 + v.z) - v.z;
    const float sine = std::sqrt(std::clamp(1 - z * z, 0.0f, 1.0f));
    const glm::vec3 h = glm::vec3(sine * std::cos(phi), sine * std::sin(phi), z) + v;
    return glm::normalize(glm::vec3(alpha * h.x, alpha * h.y, std::max(h.z, 1e-12f)));
}

}  // namespace

Frame::Frame(const glm::vec3& normal) : n(normal) {
    const float sign = std::copysign(1.0f, n.z);
    const float a = -1.0f / (sign + n.z);
    const float b = n.x * n.y * a;
    u = {1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x};
    w = {b, sign + n.y * n.y * a, -n.y};
}

Reflection::Reflection(const Surface& s, const glm::vec3& toEye)
    : frame_(s.shadingNormal),
      brdf_(math::makeBrdf(s.baseColor, s.metallic, s.roughness, s.dielectricF0,
                           glm::dot(s.shadingNormal, toEye))),
      toEye_(frame_.toLocal(toEye)),
      toEyeAbove_(toEye_.z >= kMinNoV
                      ? toEye_
                      : glm::normalize(glm::vec3(toEye_.x, toEye_.y, kMinNoV) + glm::vec3(1e-12f, 0, 0))) {
    const float diffuse = luminance(brdf_.diffuse), specular = luminance(brdf_.albedo);
    black_ = !(diffuse + specular > 0);
    if (black_) return;
    specularShare_ = specular / (diffuse + specular);
    if (diffuse > 0 && specular > 0)
        specularShare_ = std::clamp(specularShare_, kLeastShare, 1 - kLeastShare);
}

Reflection::Value Reflection::evaluate(const glm::vec3& toLight) const {
    Value value;
    const glm::vec3 l = frame_.toLocal(toLight);
    if (!(l.z > 0) || black_) return value;
    value.diffuse = brdf_.diffuse * (l.z / kPi);
    value.density = (1 - specularShare_) * l.z / kPi;
    if (!(specularShare_ > 0)) return value;

    const glm::vec3 sum = l + toEye_;
    const float length = glm::length(sum);
    const float alpha2 = brdf_.alpha * brdf_.alpha;
    if (length > 1e-12f) {
        const glm::vec3 h = sum / length;
        if (h.z > 0) {
            const float NoV = brdf_.NoV, NoL = std::max(l.z, kMinNoV);
            const float smith = NoL * std::sqrt(NoV * NoV * (1 - alpha2) + alpha2) +
                                NoV * std::sqrt(NoL * NoL * (1 - alpha2) + alpha2);
            const float VoH = std::clamp(glm::dot(toEye_, h), 0.0f, 1.0f);
            value.specular = math::fresnel(brdf_.f0, brdf_.f90, VoH) * brdf_.compensation *
                             (ggx(alpha2, h) * 0.5f / std::max(smith, 1e-7f) * l.z);
        }
    }
    const glm::vec3 h = glm::normalize(l + toEyeAbove_);
    value.density += specularShare_ * visibleDensity(alpha2, ggx(alpha2, h), toEyeAbove_.z);
    return value;
}

glm::vec3 Reflection::sample(float lobe, const glm::vec2& u) const {
    if (lobe < specularShare_) {
        const glm::vec3 h = sampleVisibleNormal(toEyeAbove_, brdf_.alpha, u);
        return frame_.toWorld(2 * glm::dot(toEyeAbove_, h) * h - toEyeAbove_);
    }
    const float phi = 2 * kPi * u.x;
    const float radius = std::sqrt(u.y);
    return frame_.toWorld({radius * std::cos(phi), radius * std::sin(phi), std::sqrt(1 - u.y)});
}

glm::vec3 uniformHemisphere(const glm::vec3& normal, const glm::vec2& u) {
    const float phi = 2 * kPi * u.x;
    const float sine = std::sqrt(std::max(1 - u.y * u.y, 0.0f));
    return Frame(normal).toWorld({sine * std::cos(phi), sine * std::sin(phi), u.y});
}

}  // namespace conelight::reference
