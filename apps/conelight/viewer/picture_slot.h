// SPDX-License-Identifier: MIT
// One picture of the session in one mode, as a texture: a renderer of its own for the GL modes, the path
// tracer in the background for `reference`. The window has one, two when it is split.
#pragma once

#include <memory>
#include <string>

#include "conelight/renderer.h"
#include "session/session.h"
#include "viewer/background_reference.h"

namespace conelight::program {

class PictureSlot {
  public:
    PictureSlot(std::string shaderDirectory, bool debugGl);
    ~PictureSlot();
    PictureSlot(const PictureSlot&) = delete;
    PictureSlot& operator=(const PictureSlot&) = delete;

    // Brings the picture up to date. `width` x `height` is what is drawn, `full` whether that is the window's
    // resolution (the reference starts only then). Returns whether drawing again would change it.
    bool draw(const Session& session, const std::string& mode, int width, int height, bool full);
    void redraw();  // the next draw draws although nothing changed
    // Frees what the slot holds; the next draw starts anew.
    void clear();

    std::uint32_t texture() const;  // tone-mapped, row 0 on top; 0: nothing yet
    int width() const;
    int height() const;
    const Image& linear();            // reads it back when it has not been yet
    double frameMs() const;           // wall time of the last frame that was drawn
    std::uint64_t version() const;    // grows with every new picture
    const FrameStats* stats() const;  // of the last GL frame; null for the reference
    ReferenceStatus referenceStatus() const;
    Renderer* renderer();  // null unless a GL mode is shown

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace conelight::program
