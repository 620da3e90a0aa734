// SPDX-License-Identifier: MIT
// The middle of the window: the picture, what a click found over it, and labels: the mode of each half, what
// the reference is at, what the window is busy with, why there may be nothing to see.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>

#include "session/session.h"
#include "viewer/picture_view.h"
#include "viewer/pixel_probe.h"
#include "viewer/selection_outline.h"

namespace conelight::program {

class PicturePanel {
  public:
    struct Inputs {
        Session& session;
        PictureView& view;
        PixelProbe& probe;
        const std::optional<std::string>& hint;
    };
    explicit PicturePanel(const Inputs& inputs) : in_(inputs) {}

    // `seconds`: of movement since the last time. Returns where the picture was clicked.
    std::optional<PictureView::Click> show(const glm::vec2& at, const glm::vec2& size, float seconds);

  private:
    void showLabels(const glm::vec2& at, const glm::vec2& size);
    void showInstruments(const glm::vec2& at, const glm::vec2& size);
    void showWork(const glm::vec2& at, const glm::vec2& size);
    void showText(const std::string& text, const glm::vec2& at, const glm::vec2& size);

    Inputs in_;
    SelectionOutline outline_;
};

}  // namespace conelight::program
