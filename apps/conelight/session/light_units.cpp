// SPDX-License-Identifier: MIT
#include "session/light_units.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "io/scene_info.h"

namespace conelight::program {
namespace {

constexpr glm::vec3 kLuminanceOfRgb{0.2126f, 0.7152f, 0.0722f};  // Rec.709

float largest(const glm::vec3& v) { return std::max({v.r, v.g, v.b}); }

float luminous(const glm::vec3& radiant) {
    return static_cast<float>(kLumenPerWatt) * glm::dot(radiant, kLuminanceOfRgb);
}

// A lobe of the colour matching functions: a Gaussian with a width on either side, nm.
double lobe(double nm, double mean, double left, double right) {
    const double t = (nm - mean) / (nm < mean ? left : right);
    return std::exp(-0.5 * t * t);
}

glm::dvec3 colorMatching(double nm) {
    return {1.056 * lobe(nm, 599.8, 37.9, 31.0) + 0.362 * lobe(nm, 442.0, 16.0, 26.7) -
                0.065 * lobe(nm, 501.1, 20.4, 26.2),
            0.821 * lobe(nm, 568.8, 46.9, 40.5) + 0.286 * lobe(nm, 530.9, 16.3, 31.1),
            1.217 * lobe(nm, 437.0, 11.8, 36.0) + 0.681 * lobe(nm, 459.0, 26.0, 13.8)};
}

// Share of red and green in the sum.
glm::vec2 chromaticity(const glm::vec3& color) {
    const float sum = color.r + color.g + color.b;
    return sum > 0 ? glm::vec2(color) / sum : glm::vec2(1.0f / 3);
}

// Along the reciprocal of temperature colours change evenly.
constexpr int kLocusPoints = 256;
float kelvinAt(float point) {
    const float part = point / (kLocusPoints - 1);
    return 1 / glm::mix(1 / kLeastKelvin, 1 / kMostKelvin, part);
}

}  // namespace

const char* unitName(LightType type, LightUnit unit) {
    if (unit == LightUnit::RadiantFlux) return "W";
    if (unit == LightUnit::LuminousFlux) return "lm";
    if (unit == LightUnit::Radiant) return io::lightUnit(type);
    return type == LightType::Directional ? "lx" : hasArea(type) ? "cd/m^2" : "cd";
}

std::vector<LightUnit> unitsOf(const Light& light) {
    if (!radiantFlux(light)) return {LightUnit::Radiant, LightUnit::Luminous};
    return {LightUnit::Radiant, LightUnit::RadiantFlux, LightUnit::Luminous, LightUnit::LuminousFlux};
}

float strengthIn(const Light& light, LightUnit unit) {
    const glm::vec3 flux = radiantFlux(light).value_or(glm::vec3(0));
    switch (unit) {
        case LightUnit::Radiant:
            return largest(light.intensity);
        case LightUnit::RadiantFlux:
            return largest(flux);
        case LightUnit::Luminous:
            return luminous(light.intensity);
        case LightUnit::LuminousFlux:
            return luminous(flux);
    }
    return 0;
}

void setStrength(Light& light, LightUnit unit, float value) {
    if (!(largest(light.intensity) > 0)) light.intensity = glm::vec3(1);
    // Strengths are proportional to the intensity. One that would round away is scaled to 1 first.
    light.intensity /= largest(light.intensity);
    const float one = strengthIn(light, unit);
    if (one > 0)
        light.intensity *= std::max(value, 0.0f) / one;  // else: it sends nothing, whatever its intensity
}

glm::vec3 blackbodyColor(float kelvin) {
    constexpr double kSecondRadiation = 1.438776877e7;  // nm K (CODATA 2018)
    constexpr double kStep = 5;                         // nm
    glm::dvec3 xyz(0);
    for (double nm = 380; nm <= 780; nm += kStep)
        xyz += colorMatching(nm) /
               (std::pow(nm / 560, 5) * std::expm1(kSecondRadiation / (nm * static_cast<double>(kelvin))));
    const glm::dmat3 rgbFromXyz(3.2404542, -0.9692660, 0.0556434, -1.5371385, 1.8760108, -0.2040259,
                                -0.4985314, 0.0415560, 1.0572252);
    const glm::vec3 rgb = glm::max(glm::vec3(glm::normalize(rgbFromXyz * xyz)), glm::vec3(0));
    return rgb / largest(rgb);
}

std::optional<float> kelvinOf(const glm::vec3& color) {
    static const std::vector<glm::vec2> kLocus = [] {
        std::vector<glm::vec2> points;
        for (int i = 0; i < kLocusPoints; ++i)
            points.push_back(chromaticity(blackbodyColor(kelvinAt(static_cast<float>(i)))));
        return points;
    }();
    const glm::vec2 wanted = chromaticity(color);
    float best = 0, nearest = std::numeric_limits<float>::max();
    for (std::size_t i = 0; i + 1 < kLocus.size(); ++i) {
        const glm::vec2 d = kLocus[i + 1] - kLocus[i];
        const float along =
            std::clamp(glm::dot(wanted - kLocus[i], d) / std::max(glm::dot(d, d), 1e-12f), 0.0f, 1.0f);
        const float distance = glm::length(wanted - kLocus[i] - along * d);
        if (distance >= nearest) continue;
        nearest = distance;
        best = static_cast<float>(i) + along;
    }
    constexpr float kSameColor = 0.02f;  // of chromaticity, by eye
    if (nearest > kSameColor) return std::nullopt;
    return kelvinAt(best);
}

void setKelvin(Light& light, float kelvin, LightUnit keep) {
    const float strength = strengthIn(light, keep);
    light.intensity = blackbodyColor(std::clamp(kelvin, kLeastKelvin, kMostKelvin));
    setStrength(light, keep, strength);
}

}  // namespace conelight::program
