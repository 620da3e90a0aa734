// SPDX-License-Identifier: MIT
// How coarse pictures are drawn while the camera moves: as fine as a frame takes no longer than a target, in
// steps of half the pixels, so that what is kept over frames of one size is not thrown away at each. Coarser
// than what pays is never chosen: part of a frame's cost does not depend on its pixels.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace conelight::program {

class MovingResolution {
  public:
    static constexpr int kLevels = 7;  // the coarsest has 1/8 of the edge

    explicit MovingResolution(double targetMs) : targetMs_(targetMs) {}
    float scale() const { return std::exp2(-0.5f * static_cast<float>(level_)); }
    int level() const { return level_; }

    // A frame of the present level took this long.
    void measured(double ms) {
        double& known = ms_[static_cast<std::size_t>(level_)];
        known = known > 0 ? 0.5 * (known + ms) : ms;
        // Twice the pixels cost at most twice as much, whatever they cost when the machine had more to do.
        const double finer = level_ > 0 ? std::min(msAt(level_ - 1, 2 * known), 2 * known) : 0;
        const double coarser = level_ + 1 < kLevels ? msAt(level_ + 1, 0.5 * known) : known;
        if (known > targetMs_ && coarser < kPays * known)
            ++level_;
        else if (level_ > 0 && (finer < kSure * targetMs_ || kPays * finer < known))
            --level_;
    }
    // A movement begins: what frames cost may be different from the last one. `stillMs`: of a picture at
    // rest, of which as many pixels less are drawn as it is too slow; 0: not known.
    void begin(double stillMs) {
        ms_.fill(0);
        if (!(stillMs > 0)) return;
        level_ = 0;
        while (level_ + 1 < kLevels && stillMs > targetMs_ * std::exp2(level_)) ++level_;
    }

  private:
    // Fewer pixels must save this much (chosen by eye), and a finer picture must fit with this margin.
    static constexpr double kPays = 0.85, kSure = 0.8;
    double msAt(int level, double estimate) const {
        const double known = ms_[static_cast<std::size_t>(level)];
        return known > 0 ? known : estimate;
    }

    double targetMs_;
    int level_ = 2;
    std::array<double, kLevels> ms_{};  // 0: not known
};

}  // namespace conelight::program
