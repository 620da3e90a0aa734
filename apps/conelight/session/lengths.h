// SPDX-License-Identifier: MIT
// Lengths for rulers: round ones, and as text with the unit that suits.
#pragma once

#include <fmt/core.h>

#include <cmath>
#include <string>

namespace conelight::program {

// The largest of 1, 2 and 5 times a power of ten, m, that is not above `most`, which is positive.
inline float roundLengthBelow(float most) {
    const float power = std::pow(10.0f, std::floor(std::log10(most)));
    for (const float factor : {5.0f, 2.0f})
        if (factor * power <= 1.0001f * most) return factor * power;
    return power;
}

inline std::string lengthText(float metres) {
    struct Unit {
        float metres;
        const char* name;
    };
    for (const Unit unit : {Unit{1000, "km"}, {1, "m"}, {0.01f, "cm"}, {0.001f, "mm"}})
        if (metres >= 0.999f * unit.metres) return fmt::format("{:.4g} {}", metres / unit.metres, unit.name);
    return fmt::format("{:.4g} um", 1e6f * metres);
}

}  // namespace conelight::program
