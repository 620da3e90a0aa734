// SPDX-License-Identifier: MIT
// What the window costs: from the program's start to the first picture, CPU time of the GUI in each frame with what
// its thread rasterizes, and how long the window did not look for input.
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
    // The window looks for input, and is done with what it did since it looked before.
    void beginLook();
    void endLook();
    // The longest time between two looks since the last call, and how many there were.
    struct Pauses {
        double longestMs = 0;
        int looks = 0;
    };
    const Pauses& pauses() const { return pauses_; }
    void forgetPauses() { pauses_ = {}; }
    std::string summary(const FrameTimes& pictures) const;

  private:
    double startedMs_, firstPictureMs_ = -1;
    double guiBeganMs_ = 0, lookedMs_ = -1;
    Pauses pauses_;
    FrameTimes gui_;
};

}  // namespace conelight::program
