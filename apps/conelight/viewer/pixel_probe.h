// SPDX-License-Identifier: MIT
// What lies under a pixel: a click selects the light whose icon is there, else the object, and keeps what the pixel
// gathered, for the panel beside the picture and the lines over it, until the scene or the settings change.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>

#include "session/picker.h"
#include "session/session.h"
#include "viewer/panels.h"
#include "viewer/picture_view.h"

namespace conelight::program {

class PixelProbe {
  public:
    PixelProbe(Session& session, PictureView& view) : session_(session), view_(view) {}

    void inspect(const PictureView::Click& click);
    // The same in two: the second takes long, above all the first time, when programs are built. It goes on beside the
    // window, if there is something to gather; follow() takes what it finds.
    void select(const PictureView::Click& click);
    bool gather();
    // Selects what is there, without a look at its light: beside the others when the click adds; else it alone,
    // unless it is selected already or there is nothing.
    void choose(const PictureView::Click& click);
    void inspectPixel(const glm::ivec2& pixel);  // of the left picture
    void clear() {
        found_.reset();
        gathersIn_ = gathering_ = nullptr;
    }
    void follow();  // forgets what is not so any more
    void showPanel() { inspectorPanel(session_, found_); }
    void drawOverPicture(const glm::vec2& at, const glm::vec2& size) {
        drawInspection(session_, picker_, found_, at, size);
    }
    const std::optional<Inspection>& found() const { return found_; }
    Picker& picker() { return picker_; }

  private:
    Selection at(const glm::vec2& part);
    std::optional<Pick> pickAt(const glm::vec2& part, const glm::ivec2& size);

    Session& session_;
    PictureView& view_;
    Picker picker_;
    std::optional<Inspection> found_;
    PictureSlot* gathersIn_ = nullptr;  // what gather() will look at; null: nothing
    PictureSlot* gathering_ = nullptr;  // what it looks at
    // What it was found in.
    std::uint64_t tables_ = 0;
    std::string mode_;
    Settings settings_;
};

}  // namespace conelight::program
