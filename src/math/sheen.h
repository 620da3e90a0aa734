// SPDX-License-Identifier: MIT
// The sheen of cloth: fibres that stand up from it scatter grazing light. A microfacet term without Fresnel of Estevez
// and Kulla 2017, "Production Friendly Microfacet Sheen BRDF": D = (2 + 1/a) sin(h)^(1/a) / (2 pi), a = roughness^2, and
// their masking function. C++ twin of shaders/lib/sheen.glsl.
//
// That masking sends back more than arrives where smooth sheen is grazed. There the term is scaled down to what arrives
// (sheenScale). Its directional albedo has no closed form: it is tabulated at first use (sheenTable, 0.1 s).
#pragma once

#include <array>
#include <glm/glm.hpp>

namespace conelight::math {

// Smoother sheen would be a line at the silhouette.
constexpr float kMinSheenRoughness = 0.07f;

// The term, 1/sr, for cosines of the half vector, to the light and to the eye, and a perceptual roughness.
float sheenVisible(float roughness, float NoH, float NoL, float NoV);

// Directional albedo of the term, which may be above 1: columns by the square root of NoV from 0 to 1, rows by
// roughness from kMinSheenRoughness to 1.
constexpr int kSheenTableEdge = 32;
using SheenTable = std::array<float, std::size_t{kSheenTableEdge} * kSheenTableEdge>;
const SheenTable& sheenTable();

// Of white sheen: its factor on the term, at most 1, and the share of light that it then sends to the eye.
struct SheenShare {
    float scale;
    float albedo;
};
SheenShare sheenShare(float NoV, float roughness);
// The mean of that share over the hemisphere, by the cosine.
float evenSheen(float roughness);

// Coat and sheen in even light, for what knows a surface by one colour: what has the reflectance `base` without them has
// another with them. Coats by evenAlbedo's measure of lobes.
struct LayerAlbedo {
    float taken = 0;     // of the base's light
    glm::vec3 added{0};  // reflectance of the layers
    glm::vec3 of(const glm::vec3& base) const { return base * (1 - taken) + added; }
};
LayerAlbedo evenLayers(float coat, float coatRoughness, const glm::vec3& sheenColor, float sheenRoughness);

}  // namespace conelight::math
