// SPDX-License-Identifier: MIT
#include "reference/layers.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>

#include "reference/materials.h"

namespace conelight::reference {

Layers::Layers(const Surface& s, const glm::vec3& toEye)
    : base_(s.shadingNormal),
      coatFrame_(s.coatNormal),
      toEye_(base_.toLocal(toEye)),
      toEyeAbove_(aboveHorizon(toEye_)),
      coatToEye_(coatFrame_.toLocal(toEye)),
      coatToEyeAbove_(aboveHorizon(coatToEye_)),
      coatBrdf_(math::makeBrdf(glm::vec3(0), 0, s.coatRoughness, glm::vec3(math::kCoatF0), coatToEye_.z)),
      coat_(s.coat),
      coatMirrors_(s.coatRoughness < math::kMinRoughness),
      sheenRoughness_(s.sheenRoughness) {
    // No lobe is left whose albedo would have to be fitted.
    if (coatMirrors_) coatBrdf_.albedo = math::fresnel(coatBrdf_.f0, coatBrdf_.f90, coatBrdf_.NoV);
    const float coatPasses = 1 - coatAlbedo();
    const math::SheenShare sheen = math::sheenShare(toEyeAbove_.z, sheenRoughness_);
    sheen_ = s.sheenColor * (sheen.scale * coatPasses);
    sheenAlbedo_ = s.sheenColor * (sheen.albedo * coatPasses);
    below_ = coatPasses * (1 - largest(s.sheenColor) * sheen.albedo);
}

Layers::Lobe Layers::coatLobe(const glm::vec3& toLight) const {
    const glm::vec3 l = coatFrame_.toLocal(toLight);
    if (!(l.z > 0) || coatMirrors_ || !(coat_ > 0)) return {};
    Lobe lobe;
    const glm::vec3 sum = l + coatToEye_;
    const float length = glm::length(sum);
    if (length > 1e-12f && sum.z > 0) {
        const glm::vec3 h = sum / length;
        const float VoH = std::clamp(glm::dot(coatToEye_, h), 0.0f, 1.0f);
        lobe.value = coat_ * math::fresnel(coatBrdf_.f0, coatBrdf_.f90, VoH) * coatBrdf_.compensation *
                     ggxTimesCosine(coatBrdf_.alpha, h, l.z, coatBrdf_.NoV);
    }
    const float alpha2 = coatBrdf_.alpha * coatBrdf_.alpha;
    const glm::vec3 h = glm::normalize(l + coatToEyeAbove_);
    lobe.density = visibleDensity(alpha2, ggx(alpha2, h), coatToEyeAbove_.z);
    return lobe;
}

Layers::Lobe Layers::sheenLobe(const glm::vec3& toLight) const {
    const glm::vec3 l = base_.toLocal(toLight);
    if (!(l.z > 0) || sheenAlbedo_ == glm::vec3(0)) return {};
    const glm::vec3 h = glm::normalize(l + toEyeAbove_);
    return {sheen_ * (math::sheenVisible(sheenRoughness_, h.z, l.z, toEyeAbove_.z) * l.z),
            1 / (2 * glm::pi<float>())};
}

glm::vec3 Layers::drawCoat(const glm::vec2& u) const {
    if (coatMirrors_)
        return glm::normalize(
            coatFrame_.toWorld({-coatToEyeAbove_.x, -coatToEyeAbove_.y, coatToEyeAbove_.z}));
    const glm::vec3 h = sampleVisibleNormal(coatToEyeAbove_, coatBrdf_.alpha, u);
    return glm::normalize(coatFrame_.toWorld(2 * glm::dot(coatToEyeAbove_, h) * h - coatToEyeAbove_));
}

glm::vec3 Layers::drawSheen(const glm::vec2& u) const { return uniformHemisphere(base_.n, u); }

float shareBelowLayers(const Surface& surface, const glm::vec3& toEye) {
    return surface.layered() ? Layers(surface, toEye).below() : 1.0f;
}

glm::vec3 evenAlbedoOfLayers(const Surface& s, const glm::vec3& base) {
    if (!s.layered()) return base;
    return math::evenLayers(s.coat, s.coatRoughness, s.sheenColor, s.sheenRoughness).of(base);
}

}  // namespace conelight::reference
