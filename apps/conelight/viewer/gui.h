// SPDX-License-Identifier: MIT
// Dear ImGui on the window: start, frame, look. Panels call ImGui themselves.
#pragma once

#include <array>
#include <deque>
#include <optional>
#include <vector>

#include "platform/window.h"

namespace conelight::program {

class Gui {
  public:
    // `scale`: of text and widgets; 0: the screen's, also when the window moves to another screen.
    explicit Gui(platform::Window& window, float scale = 0);
    ~Gui();
    Gui(const Gui&) = delete;
    Gui& operator=(const Gui&) = delete;

    void beginFrame();
    // Draws the GUI into the window's framebuffer.
    void endFrame();
    bool wantsMouse() const;     // the cursor is over the GUI or drags one of its widgets
    bool wantsKeyboard() const;  // a text field has the keys
    bool hasInput() const;       // that the last frame did not take: the next one does
    // Keys that went down, as the frame that was begun has them.
    const std::vector<platform::Window::KeyEvent>& keyPresses() const { return keyPresses_; }
    float scale() const { return scale_; }
    void setScale(float scale);  // from the next frame on; 0: the screen's
    // What setScale() was last given; nothing: it was not called.
    const std::optional<float>& chosenScale() const { return chosenScale_; }
    void setLight(bool light);  // dark letters on light grey, or the reverse
    bool light() const { return light_; }

  private:
    void applyLook();
    void takeEvents();
    void takeKeys();
    static void takeReturn();
    void takeButtons();
    platform::Window& window_;
    std::vector<platform::Window::KeyEvent> keyPresses_;        // of this frame
    std::deque<platform::Window::KeyEvent> keyEvents_;          // for frames to come
    int framesToPass_ = 0;                                      // until the next of them goes down
    std::deque<platform::Window::ButtonChange> buttonChanges_;  // for frames to come
    std::array<bool, 5> buttonsDown_{};  // as the GUI has been told, before Dear ImGui 1.87
    bool cursorWasElsewhere_ = false;    // at the last frame's change of a button, from 1.87 on
    bool followsScreen_, light_ = false;
    std::optional<float> chosenScale_;
    float scale_ = 1, wantedScale_ = 1;
};

}  // namespace conelight::program
