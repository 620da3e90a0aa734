// SPDX-License-Identifier: MIT
// The strength of a light in radiometric and photometric units, and its colour as that of a black body.
//
// Convention: luminance is 683 lm/W times Y of linear Rec.709, so that 1 W of white is 683 lm, as for green light
// of 540 THz (the definition of the candela). Watts are those of the strongest channel.
#pragma once

#include <optional>
#include <vector>

#include "conelight/scene.h"

namespace conelight::program {

inline constexpr double kLumenPerWatt = 683;
inline constexpr float kLeastKelvin = 1000, kMostKelvin = 40000;

enum class LightUnit {
    Radiant,       // as the scene has it: W/sr, W/m^2, W/(sr m^2)
    RadiantFlux,   // W
    Luminous,      // the same in cd, lx, cd/m^2
    LuminousFlux,  // lm
};
const char* unitName(LightType type, LightUnit unit);
// Those that the light has: no flux for a directional light, and for one with a falloff of its own.
std::vector<LightUnit> unitsOf(const Light& light);
float strengthIn(const Light& light, LightUnit unit);  // unit is one of unitsOf
// Keeps the colour; white where the light was dark.
void setStrength(Light& light, LightUnit unit, float value);

// Linear Rec.709 of a black body, the largest channel 1: Planck's law by the colour matching functions of Wyman,
// Sloan and Shirley, "Simple Analytic Approximations to the CIE XYZ Color Matching Functions", JCGT 2(2), 2013,
// multi-lobe. Below 1900 K blue would be negative; it is 0.
glm::vec3 blackbodyColor(float kelvin);
// Of the black body whose colour is nearest; nothing when that is another colour.
std::optional<float> kelvinOf(const glm::vec3& color);
// Gives it that colour; the strength in `keep` stays.
void setKelvin(Light& light, float kelvin, LightUnit keep);

}  // namespace conelight::program
