// SPDX-License-Identifier: MIT
// What the window costs: from the program's start to the first picture, and CPU time of the GUI in each
// frame.
#pragma once

#include <string>

#include "session/frame_times.h"

namespace conelight::program {

class Timings {
  public:
    // `startedMs`: of the steady clock.
    explicit Timings(double startedMs) : startedMs_(startedMs) {}

    // Notes the first call, returns whether it was that.
    bool noteFirstPicture();
    std::string firstPictureText() const;
    double firstPictureMs() const { return firstPictureMs_; }  // since the start; < 0: not yet
    void beginGui();
    void endGui();
    const FrameTimes& gui() const { return gui_; }
    std::string summary(const FrameTimes& pictures) const;

  private:
    double startedMs_, firstPictureMs_ = -1;
    double guiBeganMs_ = 0;
    FrameTimes gui_;
};

}  // namespace conelight::program
