// SPDX-License-Identifier: MIT
#include "reference/materials.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>

namespace conelight::reference {
namespace {

// Neither part is sampled more rarely than this while it reflects at all: its albedo says little about how
// much light it meets.
constexpr float kLeastShare = 0.1f;

// Between passing a pane and meeting it, neither is drawn more rarely.
constexpr float kLeastPass = 0.1f;

}  // namespace

float largest(const glm::vec3& color) { return std::max({color.r, color.g, color.b}); }
float luminance(const glm::vec3& color) { return 0.2126f * color.r + 0.7152f * color.g + 0.0722f * color.b; }

Reflection::Reflection(const Surface& s, const glm::vec3& toEye)
    : frame_(s.shadingNormal),
      brdf_(math::makeBrdf(s.baseColor, s.metallic, s.roughness, s.dielectricF0,
                           glm::dot(s.shadingNormal, toEye))),
      toEye_(frame_.toLocal(toEye)),
      toEyeAbove_(aboveHorizon(toEye_)) {
    if (s.transmission > 0) {
        if (!passesStraight(s)) through_ = brdf_.diffuse * s.transmission;
        brdf_.diffuse *= 1 - s.transmission;
        solid_ = s.solid;
        inside_ = solid_ && !s.frontFace;
        eta_ = inside_ ? 1 / std::max(s.material->ior, 1.0f) : std::max(s.material->ior, 1.0f);
        facets_ = math::directionalAlbedo(brdf_.NoV, std::sqrt(brdf_.alpha));
        tint_ = s.baseColor * (s.transmission * (1 - s.metallic));
    }
    if (isMirror(s)) {
        // No lobe is left whose albedo would have to be fitted.
        mirror_ = true;
        brdf_.albedo = math::fresnel(brdf_.f0, brdf_.f90, brdf_.NoV);
        const math::Brdf coat =
            math::makeBrdf(s.baseColor, 0, s.roughness, s.dielectricF0, glm::dot(s.shadingNormal, toEye));
        const glm::vec3 taken = math::fresnel(coat.f0, coat.f90, coat.NoV);
        brdf_.diffuse = s.baseColor * ((1 - s.metallic) * (1 - std::min(largest(taken), 1.0f)));
    }
    const float diffuse = luminance(brdf_.diffuse), specular = luminance(brdf_.albedo);
    const float through = luminance(through_);
    black_ = !(diffuse + specular + through > 0);
    addLayers(s, toEye);
    if (black_) return;
    specularShare_ = specular / (diffuse + specular + through);
    if (diffuse + through > 0 && specular > 0)
        specularShare_ = std::clamp(specularShare_, kLeastShare, 1 - kLeastShare);
    if (through > 0) transmissionShare_ = (1 - specularShare_) * through / (diffuse + through);
}

// Shares of drawing between the base and its layers.
void Reflection::addLayers(const Surface& s, const glm::vec3& toEye) {
    if (!s.layered()) return;
    layers_.emplace(s, toEye);
    const float base = black_ ? 0.0f : layers_->below() * luminance(brdf_.diffuse + brdf_.albedo);
    const float coat = layers_->coatAlbedo(), sheen = luminance(layers_->sheenAlbedo());
    const float all = base + coat + sheen;
    if (!(all > 0)) return layers_.reset();
    const auto share = [&](float one) { return one > 0 ? std::max(one / all, kLeastShare) : 0.0f; };
    const float total = share(base) + share(coat) + share(sheen);
    coatShare_ = share(coat) / total;
    sheenShare_ = share(sheen) / total;
    baseShare_ = share(base) / total;
}

Reflection::Value Reflection::evaluate(const glm::vec3& toLight) const {
    Value value = evaluateBase(toLight);
    if (!layers_) return value;
    const Layers::Lobe coat = layers_->coatLobe(toLight), sheen = layers_->sheenLobe(toLight);
    value.diffuse *= layers_->below();
    value.specular = layers_->below() * value.specular + coat.value + sheen.value;
    value.density = baseShare_ * value.density + coatShare_ * coat.density + sheenShare_ * sheen.density;
    return value;
}

glm::vec3 Reflection::mirrorShare() const {
    glm::vec3 share = mirror_ ? brdf_.albedo : glm::vec3(0);
    if (!layers_) return share;
    share *= layers_->below();
    return layers_->coatMirrors() ? share + layers_->coatAlbedo() : share;
}

Reflection::Value Reflection::evaluateBase(const glm::vec3& toLight) const {
    Value value;
    glm::vec3 l = frame_.toLocal(toLight);
    const bool below = scattersThrough() && l.z < 0;
    if (below) l.z = -l.z;
    if (!(l.z > 0) || black_) return value;
    if (!below) {
        value.diffuse = brdf_.diffuse * (l.z / glm::pi<float>());
        value.density = (1 - specularShare_ - transmissionShare_) * l.z / glm::pi<float>();
        if (!(specularShare_ > 0) || mirror_) return value;
    }

    const glm::vec3 sum = l + toEye_;
    const float length = glm::length(sum);
    const float alpha2 = brdf_.alpha * brdf_.alpha;
    if (length > 1e-12f) {
        const glm::vec3 h = sum / length;
        if (h.z > 0) {
            const float VoH = std::clamp(glm::dot(toEye_, h), 0.0f, 1.0f);
            // What a pane scatters through fills the mirrored lobe, whose facets then send all of it.
            const glm::vec3 facets = below ? through_ / (facets_.x + facets_.y)
                                           : math::fresnel(brdf_.f0, brdf_.f90, VoH) * brdf_.compensation;
            value.specular = facets * ggxTimesCosine(brdf_.alpha, h, l.z, brdf_.NoV);
        }
    }
    const glm::vec3 h = glm::normalize(l + toEyeAbove_);
    value.density +=
        (below ? transmissionShare_ : specularShare_) * visibleDensity(alpha2, ggx(alpha2, h), toEyeAbove_.z);
    return value;
}

Reflection::Draw Reflection::draw(float lobe, const glm::vec2& u) const {
    if (!layers_) return drawBase(lobe, u);
    Draw drawn;
    if (lobe < coatShare_) {
        drawn.direction = layers_->drawCoat(u);
        if (!layers_->coatMirrors()) return drawn;
        drawn.alone = drawn.mirrored = true;
        drawn.value.density = 1;
        drawn.value.specular = glm::vec3(layers_->coatAlbedo() / coatShare_);
        return drawn;
    }
    lobe -= coatShare_;
    if (lobe < sheenShare_) {
        drawn.direction = layers_->drawSheen(u);
        return drawn;
    }
    if (!(baseShare_ > 0)) return {};
    drawn = drawBase(std::min((lobe - sheenShare_) / baseShare_, 0.99999994f), u);
    drawn.value.specular *= layers_->below() / baseShare_;
    return drawn;
}

Reflection::Draw Reflection::drawBase(float lobe, const glm::vec2& u) const {
    if (inside_) return drawInside(lobe, u);
    if (lobe >= 1 - transmissionShare_ && transmissionShare_ > 0) return drawThrough(u);
    Draw drawn;
    if (mirror_ && lobe < specularShare_) {
        drawn.direction = glm::normalize(frame_.toWorld({-toEyeAbove_.x, -toEyeAbove_.y, toEyeAbove_.z}));
        drawn.alone = drawn.mirrored = true;
        drawn.value.density = 1;
        drawn.value.specular = brdf_.albedo / specularShare_;
        return drawn;
    }
    drawn.direction = glm::normalize(sample(lobe, u));
    return drawn;
}

// How a facet that the eye sees splits light.
Reflection::Facet Reflection::facet(const glm::vec2& u) const {
    const glm::vec3 h = sampleVisibleNormal(toEyeAbove_, brdf_.alpha, u);
    const float VoH = glm::dot(toEyeAbove_, h), cosine2 = 1 - (1 - VoH * VoH) / (eta_ * eta_);
    Facet f;
    f.mirrored = 2 * VoH * h - toEyeAbove_;
    // Beyond the critical angle there is no way through.
    if (solid_ && !(cosine2 > 0)) return f;
    const float cosine = std::sqrt(std::max(cosine2, 0.0f));
    f.refracted = (VoH / eta_ - cosine) * h - toEyeAbove_ / eta_;
    f.reflected = math::fresnel(brdf_.f0, brdf_.f90, inside_ ? cosine : VoH);  // by the cosine in air
    return f;
}

Reflection::Draw Reflection::drawThrough(const glm::vec2& u) const {
    const Facet f = facet(u);
    Draw drawn;
    drawn.below = true;
    if (!solid_) {
        if (!(f.mirrored.z > 0)) return {};
        drawn.direction = glm::normalize(frame_.toWorld({f.mirrored.x, f.mirrored.y, -f.mirrored.z}));
        return drawn;
    }
    if (!(f.refracted.z < 0)) return {};
    drawn.direction = glm::normalize(frame_.toWorld(f.refracted));
    drawn.alone = true;
    drawn.value.density = 1;
    // Facets in each other's shadow lose light that others catch: the mean of what is drawn is through_.
    const glm::vec3 mean = facets_.x + facets_.y - (brdf_.f0 * facets_.x + brdf_.f90 * facets_.y);
    drawn.value.specular = through_ / glm::max(mean, 1e-3f) * (1.0f - f.reflected) *
                           maskedShare(-f.refracted.z) / transmissionShare_;
    return drawn;
}

// At the inner side of a solid: back into it, or out of it.
Reflection::Draw Reflection::drawInside(float lobe, const glm::vec2& u) const {
    const Facet f = facet(u);
    const float back = std::clamp(luminance(f.reflected), 0.0f, 1.0f);
    Draw drawn;
    drawn.below = !(lobe < back);
    const glm::vec3 l = drawn.below ? f.refracted : f.mirrored;
    if (!(drawn.below ? l.z < 0 : l.z > 0)) return {};
    drawn.direction = glm::normalize(frame_.toWorld(l));
    drawn.alone = true;
    drawn.value.density = 1;
    drawn.value.specular = drawn.below ? tint_ * (1.0f - f.reflected) / (1 - back) : f.reflected / back;
    return drawn;
}

// G2 / G1 of the height-correlated Smith function: what is drawn by visible normals is left by this share.
float Reflection::maskedShare(float NoL) const {
    const float a2 = brdf_.alpha * brdf_.alpha, NoV = toEyeAbove_.z;
    const float v = std::sqrt(NoV * NoV * (1 - a2) + a2), l = std::sqrt(NoL * NoL * (1 - a2) + a2);
    return NoL * (NoV + v) / std::max(NoL * v + NoV * l, 1e-7f);
}

bool isMirror(const Surface& surface) {
    return !(surface.transmission > 0) && surface.roughness < math::kMinRoughness;
}

bool passesStraight(const Surface& surface) {
    return surface.transmission > 0 && !surface.solid && surface.roughness <= math::kMinRoughness;
}

StraightPass straightPass(const Surface& s, const glm::vec3& toEye) {
    const math::Brdf brdf = math::makeBrdf(s.baseColor, s.metallic, s.roughness, s.dielectricF0,
                                           glm::dot(s.shadingNormal, toEye));
    StraightPass pass{brdf.diffuse * s.transmission, 0};
    const float passes = luminance(pass.transmittance);
    const float meets = luminance(brdf.diffuse) * (1 - s.transmission) + luminance(brdf.albedo);
    if (passes > 0) pass.share = std::clamp(passes / (passes + meets), kLeastPass, 1 - kLeastPass);
    return pass;
}

glm::vec3 absorption(const Material& material) {
    if (!(material.attenuationDistance > 0)) return glm::vec3(0);
    return -glm::log(material.attenuationColor) / material.attenuationDistance;
}

glm::vec3 Reflection::sample(float lobe, const glm::vec2& u) const {
    if (lobe < specularShare_) {
        const glm::vec3 h = sampleVisibleNormal(toEyeAbove_, brdf_.alpha, u);
        return frame_.toWorld(2 * glm::dot(toEyeAbove_, h) * h - toEyeAbove_);
    }
    const float phi = 2 * glm::pi<float>() * u.x;
    const float radius = std::sqrt(u.y);
    return frame_.toWorld({radius * std::cos(phi), radius * std::sin(phi), std::sqrt(1 - u.y)});
}

glm::vec3 uniformHemisphere(const glm::vec3& normal, const glm::vec2& u) {
    const float phi = 2 * glm::pi<float>() * u.x;
    const float sine = std::sqrt(std::max(1 - u.y * u.y, 0.0f));
    return Frame(normal).toWorld({sine * std::cos(phi), sine * std::sin(phi), u.y});
}

}  // namespace conelight::reference
