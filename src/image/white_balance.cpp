// SPDX-License-Identifier: MIT
// The white of a lamp, a black body, by Krystek's fit in the CIE 1960 diagram ("An algorithm to calculate correlated colour
// temperature", 1985; 1000 to 15000 K), and of what lies beside it, along the normal of the curve. Adapted by the von
// Kries rule in Bradford's cones (Lam 1985).
#include "image/white_balance.h"

namespace conelight::image {
namespace {

constexpr float kNeutralKelvin = 6500;
// Lamps lie on the curve of the black body; daylight, from here on, up to so far beside it (D65, Duv).
constexpr double kDaylightKelvin = 4000, kDaylightDuv = 0.0032;

// CIE 1960 u, v.
glm::dvec2 blackBody(double t) {
    return {(0.860117757 + 1.54118254e-4 * t + 1.28641212e-7 * t * t) /
                (1 + 8.42420235e-4 * t + 7.08145163e-7 * t * t),
            (0.317398726 + 4.22806245e-5 * t + 4.20481691e-8 * t * t) /
                (1 - 2.89741816e-5 * t + 1.61456053e-7 * t * t)};
}

// XYZ of luminance 1. Towards green is away from purple: the side of larger v.
glm::dvec3 whiteOf(double kelvin, double tint) {
    const glm::dvec2 along = glm::normalize(blackBody(kelvin * 1.001) - blackBody(kelvin / 1.001));
    glm::dvec2 green(-along.y, along.x);
    if (green.y < 0) green = -green;
    const double daylight = glm::clamp((kelvin - kDaylightKelvin) / (6500 - kDaylightKelvin), 0.0, 1.0);
    const glm::dvec2 uv = blackBody(kelvin) + (1e-3 * tint + kDaylightDuv * daylight) * green;
    const double x = 3 * uv.x / (2 * uv.x - 8 * uv.y + 4), y = 2 * uv.y / (2 * uv.x - 8 * uv.y + 4);
    return {x / y, 1, (1 - x - y) / y};
}

}  // namespace

glm::mat3 whiteBalance(float kelvin, float tint) {
    if (kelvin == kNeutralKelvin && tint == 0) return glm::mat3(1);
    // Columns.
    const glm::dmat3 xyzFromRgb(0.4123908, 0.2126390, 0.0193308, 0.3575843, 0.7151687, 0.1191948, 0.1804808,
                                0.0721923, 0.9505322);
    const glm::dmat3 conesFromXyz(0.8951, -0.7502, 0.0389, 0.2664, 1.7135, -0.0685, -0.1614, 0.0367, 1.0296);
    const glm::dvec3 ratio = conesFromXyz * whiteOf(kNeutralKelvin, 0) /
                             (conesFromXyz * whiteOf(static_cast<double>(kelvin), static_cast<double>(tint)));
    const glm::dmat3 scaled(ratio.x, 0, 0, 0, ratio.y, 0, 0, 0, ratio.z);
    const glm::dmat3 adapted = glm::inverse(conesFromXyz) * scaled * conesFromXyz;
    return glm::mat3(glm::inverse(xyzFromRgb) * adapted * xyzFromRgb);
}

}  // namespace conelight::image
