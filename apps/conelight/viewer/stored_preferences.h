// SPDX-License-Identifier: MIT
// The window's preferences in the state folder: read at the start, written when the user has changed one.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>

#include "platform/window.h"
#include "session/preferences.h"
#include "session/state_files.h"
#include "viewer/gui.h"
#include "viewer/panel_layout.h"

namespace conelight::program {

class StoredPreferences {
  public:
    // Never throws: what cannot be read is said by complaint(), and the defaults hold.
    explicit StoredPreferences(const StateFiles& state);
    const Preferences& values() const { return values_; }
    const std::string& complaint() const { return complaint_; }  // a line; "": none

    // Gives them to the window's parts.
    void apply(Gui& gui, PanelLayout& panels) const;
    // Once a frame. What options of the program set is not kept, what the user changes is.
    void follow(const platform::Window& window, const Gui& gui, const PanelLayout& panels);

  private:
    std::string file_, complaint_;
    Preferences values_;
    std::optional<glm::ivec2> firstSize_;
    bool resized_ = false;
};

}  // namespace conelight::program
