// SPDX-License-Identifier: MIT
// What a photographer reads off a picture: histograms of luminance and of the channels, a waveform, how much is clipped.
// Image + its look -> counts. Luminance is that of the scene after exposure; channels are those of the screen.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "conelight/renderer.h"

namespace conelight::program {

struct Scopes {
    static constexpr int kDarkest = -10, kBrightest = 8;  // stops about middle grey
    static constexpr int kBinsPerStop = 6;
    static constexpr int kBins = (kBrightest - kDarkest) * kBinsPerStop;
    static constexpr int kLevels = 128;   // of a channel, two of its 256 each
    static constexpr int kColumns = 192;  // of the waveform

    // Luminance beyond either end is in the last bin there.
    std::array<std::uint32_t, kBins> luminance{};
    std::array<std::array<std::uint32_t, kLevels>, 3> channels{};
    // Per channel: kColumns x kLevels, level 0 first.
    std::array<std::vector<std::uint32_t>, 3> waveform;
    std::uint32_t pixels = 0, over = 0, under = 0;  // one channel at its most; all channels black
    float median = 0;                               // stops

    double part(std::uint32_t count) const { return pixels > 0 ? static_cast<double>(count) / pixels : 0; }
};

// Of large pictures every second pixel, every third and so on counts.
Scopes scopesOf(const Image& linear, const ImageSettings& look);

// RGB bytes, kColumns x kLevels, the brightest level on top.
std::vector<std::uint8_t> waveformPicture(const Scopes& scopes);

// "median -1.2 stops, 0.3 % over, 4 % under".
std::string scopesText(const Scopes& scopes);

}  // namespace conelight::program
