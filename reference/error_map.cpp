// SPDX-License-Identifier: MIT
// Error per pixel, and the colours that show it. Scales: Magma (Smith and van der Walt for matplotlib, CC0),
// every 16th of its 256 colours; RdBu with 11 classes (Brewer, ColorBrewer 2.0), red for too bright. Linear
// between.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "reference/metric_parts.h"

namespace conelight::reference {
namespace {

using Rgb = std::array<std::uint8_t, 3>;

constexpr Rgb kMagma[] = {{0, 0, 4},       {10, 8, 34},    {29, 17, 71},   {54, 16, 107},   {81, 18, 124},
                          {106, 28, 129},  {131, 38, 129}, {156, 46, 127}, {183, 55, 121},  {208, 65, 111},
                          {231, 82, 99},   {245, 107, 92}, {252, 137, 97}, {254, 167, 114}, {254, 196, 136},
                          {253, 226, 163}, {252, 253, 191}};
constexpr Rgb kBlueWhiteRed[] = {{5, 48, 97},     {33, 102, 172},  {67, 147, 195},  {146, 197, 222},
                                 {209, 229, 240}, {247, 247, 247}, {253, 219, 199}, {244, 165, 130},
                                 {214, 96, 77},   {178, 24, 43},   {103, 0, 31}};

template <std::size_t count>
void interpolate(const Rgb (&scale)[count], float position, std::uint8_t rgb[3]) {
    const float at = std::clamp(position, 0.0f, 1.0f) * float(count - 1);
    const std::size_t below = std::min(std::size_t(at), count - 2);
    const float part = at - float(below);
    for (std::size_t c = 0; c < 3; ++c)
        rgb[c] = static_cast<std::uint8_t>(
            std::lround((1 - part) * float(scale[below][c]) + part * float(scale[below + 1][c])));
}

double meanChannel(const Colors& colors, const std::vector<std::uint8_t>& usable) {
    double sum = 0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < usable.size(); ++i) {
        if (!usable[i]) continue;
        for (int c = 0; c < 3; ++c) sum += colors.pixels[i][c];
        count += 3;
    }
    return sum / static_cast<double>(count);
}

float relativeSquared(const glm::vec3& x, const glm::vec3& r) {
    const glm::vec3 difference = x - r;
    const glm::vec3 relative = difference * difference / (r * r + 0.01f);  // as Metrics::relMse
    return (relative.r + relative.g + relative.b) / 3;
}

}  // namespace

std::vector<float> errorValues(const Image& test, const Image& reference, ErrorMap map,
                               const MetricOptions& options) {
    const std::vector<std::uint8_t> usable = usablePixels({&test, &reference}, options.pixels);
    const Colors x = usableColors(test, usable);
    const Colors r = usableColors(reference, usable);
    std::vector<float> values(usable.size());
    switch (map) {
        case ErrorMap::Signed:
        case ErrorMap::Absolute: {
            const float mean = static_cast<float>(meanChannel(r, usable));
            for (std::size_t i = 0; i < values.size(); ++i) {
                const float difference = luminanceOf(x.pixels[i] - r.pixels[i]);
                // A difference from a black reference is beyond any scale, with its sign.
                const float part = difference == 0 ? 0.0f : difference / mean;
                values[i] = map == ErrorMap::Signed ? part : std::abs(part);
            }
            break;
        }
        case ErrorMap::RelativeSquared:
            for (std::size_t i = 0; i < values.size(); ++i)
                values[i] = relativeSquared(x.pixels[i], r.pixels[i]);
            break;
        case ErrorMap::Flip:
            values = ldrFlip(displayColors(x, options.exposure), displayColors(r, options.exposure),
                             options.pixelsPerDegree);
            break;
        case ErrorMap::HdrFlip:
            values = hdrFlip(x, r, options.pixelsPerDegree);
            break;
    }
    for (std::size_t i = 0; i < values.size(); ++i)
        if (!usable[i]) values[i] = std::numeric_limits<float>::quiet_NaN();
    return values;
}

const char* nameOf(ErrorMap map) {
    switch (map) {
        case ErrorMap::Signed:
            return "signed";
        case ErrorMap::Absolute:
            return "absolute";
        case ErrorMap::RelativeSquared:
            return "relative";
        case ErrorMap::Flip:
            return "flip";
        case ErrorMap::HdrFlip:
            return "hdr-flip";
    }
    return "";
}

std::optional<ErrorMap> errorMapOf(const std::string& name) {
    for (const ErrorMap map :
         {ErrorMap::Signed, ErrorMap::Absolute, ErrorMap::RelativeSquared, ErrorMap::Flip, ErrorMap::HdrFlip})
        if (name == nameOf(map)) return map;
    return std::nullopt;
}

void colorOfError(float value, bool isSigned, std::uint8_t rgb[3]) {
    if (std::isnan(value)) {
        rgb[0] = 0, rgb[1] = 255, rgb[2] = 0;
        return;
    }
    isSigned ? interpolate(kBlueWhiteRed, value * 0.5f + 0.5f, rgb) : interpolate(kMagma, value, rgb);
}

}  // namespace conelight::reference
