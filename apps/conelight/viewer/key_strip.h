// SPDX-License-Identifier: MIT
// The key frames of the camera path on a line of time: a click on a key selects it and goes there, a drag moves it, a
// drag beside keys scrubs along the path.
#pragma once

#include <cstddef>
#include <optional>

#include "viewer/panels.h"

namespace conelight::program {

class KeyStrip {
  public:
    // Into the current ImGui window.
    void show(Session& session, const RunLine& run);

  private:
    enum class Hand { Away, Presses, Moves, Scrubs };
    struct Place;
    void takeMouse(Session& session, const Place& place);
    void draw(const Session& session, const Place& place) const;
    void showSelected(const Session& session, const RunLine& run);

    std::optional<std::size_t> selected_;
    double seconds_ = 0;      // of the view, where it was scrubbed to
    Hand hand_ = Hand::Away;  // the left button's
    double pressedX_ = 0;
    double from_ = 0, until_ = 1;  // seconds that the strip shows; they stay while the button is down
};

}  // namespace conelight::program
