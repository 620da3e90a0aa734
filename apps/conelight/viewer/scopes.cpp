// SPDX-License-Identifier: MIT
#include "viewer/scopes.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace conelight::program {
namespace {

constexpr std::size_t kEnoughPixels = 150'000;
constexpr float kGrey = 0.18f;

// Every n-th pixel in both directions, so that they are few enough.
Image thinned(const Image& image) {
    int n = 1;
    while (image.pixels.size() / static_cast<std::size_t>(n * n) > kEnoughPixels) ++n;
    if (n == 1) return image;
    Image thin{(image.width + n - 1) / n, (image.height + n - 1) / n, {}};
    for (int y = 0; y < image.height; y += n)
        for (int x = 0; x < image.width; x += n)
            thin.pixels.push_back(
                image.pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                             static_cast<std::size_t>(x)]);
    return thin;
}

int binOf(float luminance) {
    const float stops = luminance > 1e-20f ? std::log2(luminance / kGrey) : -1e3f;
    const float bin = std::floor((stops - Scopes::kDarkest) * Scopes::kBinsPerStop);
    return static_cast<int>(std::clamp(bin, 0.0f, static_cast<float>(Scopes::kBins - 1)));
}

float medianOf(const Scopes& scopes) {
    std::uint32_t seen = 0;
    for (int bin = 0; bin < Scopes::kBins; ++bin) {
        seen += scopes.luminance[static_cast<std::size_t>(bin)];
        if (2 * seen >= scopes.pixels)
            return Scopes::kDarkest + (static_cast<float>(bin) + 0.5f) / Scopes::kBinsPerStop;
    }
    return Scopes::kDarkest;
}

}  // namespace

Scopes scopesOf(const Image& linear, const ImageSettings& look) {
    Scopes scopes;
    for (std::vector<std::uint32_t>& counts : scopes.waveform)
        counts.assign(Scopes::kColumns * Scopes::kLevels, 0);
    if (linear.pixels.empty()) return scopes;
    ImageSettings plain = look;
    plain.check = ExposureCheck::Off;
    if (look.exposure.isAuto) plain.exposure = {false, autoExposure(linear)};
    const Image image = thinned(linear);
    const std::vector<std::uint8_t> bytes = toneMapped(image, plain);
    const float scale = std::exp2(plain.exposure.value);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        const glm::vec3 light = scale * glm::vec3(image.pixels[i]);
        ++scopes.luminance[static_cast<std::size_t>(
            binOf(glm::dot(light, glm::vec3(0.2126f, 0.7152f, 0.0722f))))];
        const std::uint8_t* shown = &bytes[3 * i];
        scopes.over += std::max({shown[0], shown[1], shown[2]}) == 255 ? 1 : 0;
        scopes.under += std::max({shown[0], shown[1], shown[2]}) == 0 ? 1 : 0;
        const std::size_t x = i % static_cast<std::size_t>(image.width);
        const std::size_t column = x * Scopes::kColumns / static_cast<std::size_t>(image.width);
        for (std::size_t c = 0; c < 3; ++c) {
            ++scopes.channels[c][shown[c] / 2u];
            ++scopes.waveform[c][column * Scopes::kLevels + shown[c] / 2u];
        }
    }
    scopes.pixels = static_cast<std::uint32_t>(image.pixels.size());
    scopes.median = medianOf(scopes);
    return scopes;
}

std::vector<std::uint8_t> waveformPicture(const Scopes& scopes) {
    constexpr std::size_t kColumns = Scopes::kColumns, kLevels = Scopes::kLevels;
    std::vector<std::uint8_t> rgb(3 * kColumns * kLevels, 12);
    // A level that holds an eighth of a column's pixels is at its brightest.
    const double full = static_cast<double>(scopes.pixels) / (8.0 * kColumns);
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t column = 0; column < kColumns; ++column)
            for (std::size_t level = 0; level < kLevels; ++level) {
                const std::uint32_t count = scopes.waveform[c][column * kLevels + level];
                if (count == 0) continue;
                const double bright = std::sqrt(std::min(1.0, count / std::max(full, 1.0)));
                rgb[3 * ((kLevels - 1 - level) * kColumns + column) + c] =
                    static_cast<std::uint8_t>(60 + 195 * bright);
            }
    return rgb;
}

std::string scopesText(const Scopes& scopes) {
    return fmt::format("median {:+.1f} stops, {:.3g} % over, {:.3g} % under", scopes.median,
                       100 * scopes.part(scopes.over), 100 * scopes.part(scopes.under));
}

}  // namespace conelight::program
