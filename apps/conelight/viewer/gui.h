// SPDX-License-Identifier: MIT
// Dear ImGui on the window: start, frame, look. Panels call ImGui themselves.
#pragma once

#include <string>

#include "platform/window.h"

namespace conelight::program {

class Gui {
  public:
    // Where panels remember their sizes; empty: nowhere.
    Gui(platform::Window& window, const std::string& iniFile);
    ~Gui();
    Gui(const Gui&) = delete;
    Gui& operator=(const Gui&) = delete;

    void beginFrame();
    // Draws the GUI into the window's framebuffer.
    void endFrame();
    bool wantsMouse() const;     // the cursor is over the GUI or drags one of its widgets
    bool wantsKeyboard() const;  // a text field has the keys
    float scale() const { return scale_; }

  private:
    void applyLook();
    platform::Window& window_;
    std::string iniFile_;
    float scale_ = 1;
};

}  // namespace conelight::program
