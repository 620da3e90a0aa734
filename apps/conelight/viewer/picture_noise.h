// SPDX-License-Identifier: MIT
// The noise of a picture that is a mean over passes. A mean of twice as many passes differs from the one
// before by its own standard deviation, where passes are independent: half of it is new. Light that still
// settles counts as noise. Relative to the picture's mean; pixels that are not finite do not count.
#pragma once

#include <cmath>
#include <functional>
#include <optional>
#include <utility>

#include "conelight/renderer.h"

namespace conelight::program {

class PictureNoise {
  public:
    // After each pass, the first being 1. `read` gives the picture: at passes 6, 12, 24 and so on.
    void follow(int pass, const std::function<const Image&()>& read) {
        if (pass < kFirst) {
            value_.reset();
            half_.reset();
        }
        if (pass % kFirst != 0 || !isPowerOfTwo(pass / kFirst)) return;
        const Image& whole = read();
        if (half_ && pass > kFirst) value_ = between(*half_, whole);
        half_ = whole;
    }
    const std::optional<double>& value() const { return value_; }

  private:
    static constexpr int kFirst = 6;
    static bool isPowerOfTwo(int n) { return n > 0 && (n & (n - 1)) == 0; }
    static std::optional<double> between(const Image& half, const Image& whole) {
        if (half.pixels.size() != whole.pixels.size()) return std::nullopt;
        double squares = 0, sum = 0, count = 0;
        for (std::size_t i = 0; i < whole.pixels.size(); ++i)
            for (int c = 0; c < 3; ++c) {
                const double a = static_cast<double>(half.pixels[i][c]),
                             b = static_cast<double>(whole.pixels[i][c]);
                if (!std::isfinite(a) || !std::isfinite(b)) continue;
                squares += (b - a) * (b - a);
                sum += b;
                ++count;
            }
        if (!(sum > 0)) return std::nullopt;
        return std::sqrt(squares / count) / (sum / count);
    }

    std::optional<double> value_;
    std::optional<Image> half_;
};

}  // namespace conelight::program
