// SPDX-License-Identifier: MIT
// How many faces of the light cache are updated per picture while the camera moves (traced.face_budget): as
// many as a few hundredths of a second allow. At rest all are.
#pragma once

#include <algorithm>

namespace conelight::program {

class FaceBudget {
  public:
    static constexpr int kFirst = 8192, kLeast = 1024, kMost = 1 << 24;

    explicit FaceBudget(double targetMs) : targetMs_(targetMs) {}
    // 0: all.
    int faces() const { return faces_; }
    // An update of faces() faces took this long. Changes by halves and doubles, and not for little: means
    // over pictures begin anew with it.
    void measured(double ms) {
        if (faces_ == 0)
            faces_ = ms > 2 * targetMs_ ? kFirst : 0;
        else if (ms > 2 * targetMs_)
            faces_ = std::max(faces_ / 2, kLeast);
        else if (ms < 0.4 * targetMs_)
            faces_ = std::min(faces_ * 2, kMost);
    }

  private:
    double targetMs_;
    int faces_ = 0;
};

}  // namespace conelight::program
