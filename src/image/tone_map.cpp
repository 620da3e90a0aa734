// SPDX-License-Identifier: MIT
// Linear radiance -> 8-bit picture: exposure, tone curve, sRGB (IEC 61966-2-1), rounding without dither.
// Curves: Reinhard 2002 on luminance; the filmic curve is Narkowicz's rational fit of the ACES reference
// transform ("ACES Filmic Tone Mapping Curve", 2015), applied per channel.
#include <algorithm>
#include <cmath>

#include "conelight/renderer.h"

namespace conelight {
namespace {

glm::vec3 toneCurve(const glm::vec3& c, ToneMap curve) {
    switch (curve) {
        case ToneMap::None:
            return c;
        case ToneMap::Reinhard: {
            const float luminance = glm::dot(c, glm::vec3(0.2126f, 0.7152f, 0.0722f));
            return c / (1.0f + luminance);
        }
        case ToneMap::Aces:
            return (c * (2.51f * c + 0.03f)) / (c * (2.43f * c + 0.59f) + 0.14f);
    }
    return c;
}

// From here on every curve is white in 8 bits, and far above it its polynomials overflow to inf / inf.
constexpr float kWhite = 1e6f;

float srgbFromLinear(float c) {
    return c <= 0.0031308f ? 12.92f * c : 1.055f * std::pow(c, 1.0f / 2.4f) - 0.055f;
}

}  // namespace

std::vector<std::uint8_t> toneMapped(const Image& image, const ImageSettings& settings) {
    const float scale = std::exp2(settings.exposure);
    std::vector<std::uint8_t> bytes;
    bytes.reserve(image.pixels.size() * 3);
    for (const glm::vec4& pixel : image.pixels) {
        const glm::vec3 color =
            toneCurve(glm::clamp(glm::vec3(pixel) * scale, 0.0f, kWhite), settings.toneMap);
        for (int i = 0; i < 3; ++i) {
            // A NaN shows as black here; readers of the linear image see it (conelight render counts them).
            const float linear = color[i] > 0.0f ? std::min(color[i], 1.0f) : 0.0f;
            bytes.push_back(static_cast<std::uint8_t>(
                std::lround((settings.srgb ? srgbFromLinear(linear) : linear) * 255.0f)));
        }
    }
    return bytes;
}

}  // namespace conelight
