// SPDX-License-Identifier: MIT
// Linear radiance -> picture of 8 or 16 bits: exposure, white balance, tone curve, sRGB (IEC 61966-2-1), rounding
// without dither; checks of exposure.
// Curves: Reinhard 2002 on luminance; the filmic curve is Narkowicz's rational fit of the ACES reference
// transform ("ACES Filmic Tone Mapping Curve", 2015), applied per channel; AgX is Sobotka's, with the
// matrices and the polynomial that Wrensch fitted ("Minimal AgX Implementation", 2023); Neutral is the
// Khronos PBR Neutral Tone Mapper (2024). Automatic exposure: shaders/image/exposure_sums.comp.glsl.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include "conelight/renderer.h"
#include "image/bloom.h"
#include "image/white_balance.h"
#include "shared/image.h"

namespace conelight {
namespace {

glm::vec3 agx(const glm::vec3& c) {
    const glm::mat3 inset(0.842479062f, 0.042328242f, 0.042375655f, 0.0784336f, 0.878468636f, 0.0784336f,
                          0.079223745f, 0.079166127f, 0.879142974f);
    const glm::mat3 outset(1.196879005f, -0.052896852f, -0.052971636f, -0.098020881f, 1.151903130f,
                           -0.098043450f, -0.099029744f, -0.098961177f, 1.151073673f);
    const glm::vec3 x = glm::clamp((glm::log2(glm::max(inset * c, 1e-10f)) + 12.47393f) / 16.5f, 0.0f, 1.0f);
    const glm::vec3 x2 = x * x, x4 = x2 * x2;
    const glm::vec3 curved = 15.5f * x4 * x2 - 40.14f * x4 * x + 31.96f * x4 - 6.868f * x2 * x +
                             0.4298f * x2 + 0.1191f * x - 0.00232f;
    // The fit ends at 0.99858, which 8 bits would show as less than white.
    return glm::pow(glm::max(outset * curved / 0.99858f, 0.0f), glm::vec3(2.2f));
}

glm::vec3 neutral(glm::vec3 c) {
    constexpr float kStart = 0.76f, kRoom = 0.24f, kDesaturation = 0.15f;
    const float least = std::min({c.r, c.g, c.b});
    c -= least < 0.08f ? least - 6.25f * least * least : 0.04f;
    const float peak = std::max({c.r, c.g, c.b});
    if (peak < kStart) return c;
    const float shown = 1 - kRoom * kRoom / (peak + kRoom - kStart);
    return glm::mix(glm::vec3(shown), c * (shown / peak), 1 / (kDesaturation * (peak - shown) + 1));
}

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
        case ToneMap::Agx:
            return agx(c);
        case ToneMap::Neutral:
            return neutral(c);
    }
    return c;
}

// From here on every curve is white in 8 bits, and far above it its polynomials overflow to inf / inf.
constexpr float kWhite = 1e6f;
// A matrix would make inf - inf of what is infinite.
constexpr float kFinite = 1e30f;

float srgbFromLinear(float c) {
    return c <= 0.0031308f ? 12.92f * c : 1.055f * std::pow(c, 1.0f / 2.4f) - 0.055f;
}

// RGB in all the values that a `Value` has.
template <class Value>
using Shown = glm::vec<3, Value>;
template <class Value>
constexpr float kMost = float(std::numeric_limits<Value>::max());

// A NaN shows as black here; readers of the linear image see it (conelight render counts them).
template <class Value>
Shown<Value> encoded(const glm::vec3& color, bool srgb) {
    Shown<Value> values;
    for (int i = 0; i < 3; ++i) {
        const float linear = color[i] > 0.0f ? std::min(color[i], 1.0f) : 0.0f;
        values[i] = static_cast<Value>(std::lround((srgb ? srgbFromLinear(linear) : linear) * kMost<Value>));
    }
    return values;
}

template <class Value>
Shown<Value> ofBytes(const glm::u8vec3& bytes) {
    return Shown<Value>(bytes) * static_cast<Value>(std::numeric_limits<Value>::max() / 255);
}

// Stripes over what is lost (`x` and `y` from the upper left corner).
template <class Value>
Shown<Value> clippingMarked(const Shown<Value>& shown, int x, int y) {
    constexpr Value kFull = std::numeric_limits<Value>::max();
    const bool over = shown.r == kFull || shown.g == kFull || shown.b == kFull,
               under = shown == Shown<Value>(0);
    const bool stripe = ((x + y) / CLIPPING_STRIPE & 1) == 0;
    if (!stripe || !(over || under)) return shown;
    return ofBytes<Value>(over ? glm::u8vec3(255, 0, 64) : glm::u8vec3(0, 64, 255));
}

glm::u8vec3 falseColorOf(const glm::vec3& light) {
    const float luminance = glm::dot(light, glm::vec3(0.2126f, 0.7152f, 0.0722f));
    return falseColor(std::log2((luminance > 1e-10f ? luminance : 1e-10f) / EXPOSURE_GREY));
}

template <class Value>
std::vector<Value> shownAs(const Image& image, const ImageSettings& settings) {
    std::optional<Image> spread;
    if (settings.bloom > 0) spread = image::bloomed(image, settings.bloom);
    const float scale = std::exp2(settings.exposure.isAuto ? autoExposure(image) : settings.exposure.value);
    const glm::mat3 balance = image::whiteBalance(settings.whiteBalance, settings.tint);
    const bool balances = balance != glm::mat3(1);
    std::vector<Value> values;
    values.reserve(image.pixels.size() * 3);
    int x = 0, y = 0;
    for (const glm::vec4& pixel : (spread ? *spread : image).pixels) {
        const glm::vec3 color = balances ? balance * glm::min(glm::vec3(pixel), kFinite) : glm::vec3(pixel);
        const glm::vec3 light = glm::clamp(color * scale, 0.0f, kWhite);
        Shown<Value> shown = settings.check == ExposureCheck::FalseColor
                                 ? ofBytes<Value>(falseColorOf(light))
                                 : encoded<Value>(toneCurve(light, settings.toneMap), settings.srgb);
        if (settings.check == ExposureCheck::Clipping) shown = clippingMarked<Value>(shown, x, y);
        values.insert(values.end(), {shown.r, shown.g, shown.b});
        if (++x == image.width) {
            x = 0;
            ++y;
        }
    }
    return values;
}

}  // namespace

glm::u8vec3 falseColor(float stops) {
    // By eye: no two alike, each lighter or warmer than the one before.
    static constexpr std::array<std::uint32_t, FALSE_COLORS> kColors{
        0x000000, 0x3c0a5a, 0x3228a0, 0x1e50d7, 0x1987e1, 0x1ebecd, 0x23a569, 0x808080,
        0x96c846, 0xf0e13c, 0xf5a528, 0xeb6423, 0xcd2328, 0xeb5faf, 0xffffff};
    const float place = std::clamp(stops + FALSE_COLOR_OFFSET, 0.0f, static_cast<float>(FALSE_COLORS - 1));
    const std::uint32_t color = kColors[static_cast<std::size_t>(place)];
    return {color >> 16, color >> 8 & 255u, color & 255u};
}

float autoExposure(const Image& image) {
    std::array<std::uint64_t, EXPOSURE_BINS> counts{};
    std::uint64_t total = 0;
    for (const glm::vec4& pixel : image.pixels) {
        const float luminance = glm::dot(glm::vec3(pixel), glm::vec3(0.2126f, 0.7152f, 0.0722f));
        if (!(luminance > EXPOSURE_LEAST && luminance < EXPOSURE_MOST)) continue;
        ++counts[(std::bit_cast<std::uint32_t>(luminance) >> EXPOSURE_SHIFT) - EXPOSURE_FIRST];
        ++total;
    }
    if (total == 0) return 0;
    const std::uint64_t first = total / EXPOSURE_DARKEST, end = total - total / EXPOSURE_BRIGHTEST;
    std::uint64_t seen = 0, sum = 0;
    for (std::size_t bin = 0; bin < counts.size(); ++bin) {
        const std::uint64_t from = std::max(seen, first), to = std::min(seen + counts[bin], end);
        if (to > from) sum += bin * (to - from);
        seen += counts[bin];
    }
    const double mean =
        static_cast<double>(sum) / static_cast<double>(std::max<std::uint64_t>(end - first, 1));
    const double stops = std::log2(static_cast<double>(EXPOSURE_GREY)) + 32 - 0.25 * (mean + 0.5);
    return std::clamp(static_cast<float>(stops), -EXPOSURE_LIMIT, EXPOSURE_LIMIT);
}

std::vector<std::uint8_t> toneMapped(const Image& image, const ImageSettings& settings) {
    return shownAs<std::uint8_t>(image, settings);
}

std::vector<std::uint16_t> toneMapped16(const Image& image, const ImageSettings& settings) {
    return shownAs<std::uint16_t>(image, settings);
}

}  // namespace conelight
