// SPDX-License-Identifier: MIT
#include "viewer/black_hint.h"

#include "session/why_black.h"

namespace conelight::program {

void BlackHint::follow(const Session& session, Picker& picker, PictureView& view) {
    PictureSlot& slot = view.slot(false);
    if (view.moving() || !slot.ownPicture() || slot.version() == version_ || slot.version() == 0) return;
    version_ = slot.version();
    text_.reset();
    const Image& linear = slot.linear();
    if (linear.pixels.empty() || !isBlack(linear, session.shownSettings().image)) return;
    for (const std::string& reason : whyBlack(session, picker, &linear))
        text_ = (text_ ? *text_ + "\n\n" : "The picture is black.\n\n") + reason;
    if (text_) *text_ += "\n\nKey F: the camera sees all of the selection, or of the scene.";
}

}  // namespace conelight::program
