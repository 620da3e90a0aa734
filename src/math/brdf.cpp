// SPDX-License-Identifier: MIT
#include "math/brdf.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>

namespace conelight::math {
namespace {

float largest(const glm::vec3& v) { return std::max({v.r, v.g, v.b}); }
}  // namespace

glm::vec2 directionalAlbedo(float NoV, float roughness) {
    const float a = roughness * roughness;
    const float s = NoV / (NoV + a);
    const float both =
        (0.959575f + s * (0.438832f + s * (-3.25298f + s * (5.54518f + s * -2.68982f)))) +
        a * ((0.285436f + s * (-3.13559f + s * (10.8832f + s * (-14.5516f + s * 6.2423f)))) +
             a * ((-0.689624f + s * (1.98606f + s * (-7.77566f + s * (1.51046f + s * 9.55351f)))) +
                  a * ((0.645843f + s * (-3.86254f + s * (10.699f + s * (-2.09599f + s * -18.0685f)))) +
                       a * (-0.217635f + s * (1.4135f + s * (-1.41486f + s * (-8.25343f + s * 18.5846f)))))));
    const float r = roughness;
    const float c = 1.0f - NoV;
    const float grazing =
        (1.2406f + s * (-0.0343653f + s * (-3.78446f + s * (6.60108f + s * -3.02584f)))) +
        r * ((-4.05669f + s * (0.801049f + s * (20.2115f + s * (-18.1767f + s * 1.51945f)))) +
             r * ((5.47252f + s * (-6.02894f + s * (-3.47122f + s * (-77.448f + s * 73.214f)))) +
                  r * ((-3.45332f + s * (9.0266f + s * (-24.3157f + s * (120.581f + s * -45.8689f)))) +
                       r * (0.843674f +
                            s * (-3.97724f + s * (13.7924f + s * (-43.6449f + s * -1.62864f)))))));
    const float e = std::clamp(both, 0.0f, 1.0f);
    const float f = std::clamp(grazing * (c * c) * (c * c) * c, 0.0f, e);
    return {e - f, f};
}

glm::vec3 fresnel(const glm::vec3& f0, const glm::vec3& f90, float VoH) {
    const float c = 1.0f - VoH;
    const float c2 = c * c;
    return f0 + (f90 - f0) * (c2 * c2 * c);
}

Brdf makeBrdf(const glm::vec3& baseColor, float metallic, float roughness, const glm::vec3& dielectricF0,
              float NoV) {
    Brdf b{};
    b.NoV = std::clamp(NoV, 1e-4f, 1.0f);
    const float r = std::max(roughness, kMinRoughness);
    b.alpha = r * r;
    b.f0 = glm::mix(dielectricF0, baseColor, metallic);
    b.f90 = glm::vec3(std::clamp(50.0f * largest(b.f0), 0.0f, 1.0f));
    const glm::vec2 dfg = directionalAlbedo(b.NoV, r);
    const float lost = 1.0f / (dfg.x + dfg.y) - 1.0f;
    b.compensation = 1.0f + b.f0 * lost;
    b.albedo = (b.f0 * dfg.x + b.f90 * dfg.y) * b.compensation;
    const float f0 = largest(dielectricF0);
    const float f90 = std::clamp(50.0f * f0, 0.0f, 1.0f);
    const float reflected = (f0 * dfg.x + f90 * dfg.y) * (1.0f + f0 * lost);
    b.diffuse = baseColor * ((1.0f - metallic) * std::clamp(1.0f - reflected, 0.0f, 1.0f));
    return b;
}

float evenCoat(float roughness) { return evenAlbedo(glm::vec3(0), 0, roughness, glm::vec3(kCoatF0)).r; }

MetallicSurface metallicSurface(const glm::vec3& baseColor, float metallic, const glm::vec3& dielectricF0) {
    const auto sum = [](const glm::vec3& v) { return v.r + v.g + v.b; };
    glm::vec3 more = glm::max(dielectricF0 - (kDielectricF0 + 1e-4f), 0.0f);
    if (sum(more) == 0.0f) return {baseColor, metallic, dielectricF0};
    const glm::vec3 body = baseColor * ((1.0f - largest(dielectricF0)) / (1.0f - kDielectricF0));
    float metal = sum(more) / (sum(more) + sum(body));
    more = glm::max(dielectricF0 - (1.0f - metal) * kDielectricF0, 0.0f);
    metal = sum(more) / (sum(more) + sum(body));
    const glm::vec3 color =
        glm::min(body + glm::max(dielectricF0 - (1.0f - metal) * kDielectricF0, 0.0f), 1.0f);
    return {glm::mix(color, baseColor, metallic), glm::mix(metal, 1.0f, metallic),
            glm::min(dielectricF0, kDielectricF0)};
}

glm::vec3 evenAlbedo(const glm::vec3& baseColor, float metallic, float roughness,
                     const glm::vec3& dielectricF0) {
    const MetallicSurface told = metallicSurface(baseColor, metallic, dielectricF0);
    constexpr float kEvenLobe = 0.5f;
    const float r = std::max(roughness, kMinRoughness);
    const float both =
        0.9997027f + r * (-0.01521229f + r * (0.3516476f + r * (-2.2508005f + r * 1.3269485f)));
    const float grazing =
        0.04557508f + r * (0.05997143f + r * (-0.4956394f + r * (0.670405f + r * -0.2784238f)));
    const glm::vec3& f0 = told.dielectricF0;
    const float f90 = std::clamp(50.0f * largest(f0), 0.0f, 1.0f);
    const glm::vec3 own =
        kEvenLobe * (f0 * (both - grazing) + f90 * grazing) * (1.0f + f0 * (1.0f / both - 1.0f));
    return glm::mix(told.baseColor * (1.0f - largest(own)) + own, told.baseColor, told.metallic);
}

float ggxVisible(float alpha, float NoH, float NoL, float NoV) {
    const float a2 = alpha * alpha;
    const float d = (1.0f - NoH * NoH) + NoH * NoH * a2;
    const float smithV = NoL * std::sqrt(NoV * NoV * (1.0f - a2) + a2);
    const float smithL = NoV * std::sqrt(NoL * NoL * (1.0f - a2) + a2);
    return a2 / (glm::pi<float>() * d * d) * 0.5f / std::max(smithV + smithL, 1e-7f);
}

glm::vec3 brdfSpecular(const Brdf& b, const glm::vec3& n, const glm::vec3& toLight, const glm::vec3& toEye) {
    const glm::vec3 h = glm::normalize(toLight + toEye);
    const float VoH = std::clamp(glm::dot(toEye, h), 0.0f, 1.0f);
    const float NoH = std::clamp(glm::dot(n, h), 0.0f, 1.0f);
    const float NoL = std::clamp(glm::dot(n, toLight), 1e-4f, 1.0f);
    return fresnel(b.f0, b.f90, VoH) * b.compensation * ggxVisible(b.alpha, NoH, NoL, b.NoV);
}

}  // namespace conelight::math
