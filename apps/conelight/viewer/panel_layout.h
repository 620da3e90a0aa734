// SPDX-License-Identifier: MIT
// Where the window's parts are: panels left and right, the console below, the picture in what is left. The
// borders between them can be dragged.
#pragma once

#include <glm/glm.hpp>

#include "platform/window.h"
#include "viewer/gui.h"

namespace conelight::program {

// Places of the window's parts, window units.
struct Layout {
    float top = 0, left = 0, right = 0, bottom = 0;  // thickness of bar and panels
    glm::vec2 display{0};
    glm::vec2 pictureAt() const { return {left, top}; }
    glm::vec2 pictureSize() const { return {display.x - left - right, display.y - top - bottom}; }
};

class PanelLayout {
  public:
    PanelLayout(const platform::Window& window, const Gui& gui) : window_(window), gui_(gui) {}

    bool showSide = true, showConsole = true;
    void showAll(bool shown) { showSide = showConsole = shown; }
    Layout layout() const;
    void dragBorders(const Layout& layout);
    // Of panels, in heights of text.
    struct Sizes {
        float side = 24, console = 10;
    };
    const Sizes& sizes() const { return sizes_; }
    void setSizes(const Sizes& sizes) { sizes_ = sizes; }

  private:
    const platform::Window& window_;
    const Gui& gui_;
    Sizes sizes_;
};

// Begins a panel's ImGui window at that place.
void beginPanel(const char* name, const glm::vec2& at, const glm::vec2& size);

}  // namespace conelight::program
