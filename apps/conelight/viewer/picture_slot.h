// SPDX-License-Identifier: MIT
// One picture of the session in one mode, as a texture: a renderer of its own for the GL modes; for
// `reference` the path tracer and for `radiosity` the bake, both in the background. The window has one, two
// when it is split.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "conelight/renderer.h"
#include "reference/radiosity.h"
#include "session/session.h"

namespace conelight::platform {
class RenderThread;
}

namespace conelight::program {

class PictureSlot {
  public:
    PictureSlot(RendererOptions options, platform::RenderThread& thread);
    ~PictureSlot();
    PictureSlot(const PictureSlot&) = delete;
    PictureSlot& operator=(const PictureSlot&) = delete;

    struct How {
        bool still = true;    // the view rests: work in the background may start
        bool preview = true;  // until that has something to show, draw the view in a mode of the renderer
        bool flying = false;  // the camera moves, the scene does not: what is slow may lag behind
        bool onlyChanges = false;  // leave out what merely refines the picture
    };
    // Brings the picture up to date, `width` x `height` pixels, by one part of it. Returns whether drawing
    // again soon would change it; work in the background wakes the window instead. A part that takes long goes on
    // after it has returned. Never throws: takeError() has what went wrong.
    bool draw(const Session& session, const std::string& mode, int width, int height, const How& how);
    std::optional<std::string> takeError();  // of draw, each once
    void show(const Session& session,
              Image picture);  // in place of what draw() would, until something changes
    void restInBackground();   // ends the work of mode reference there; draw() begins it again
    void setRadiosity(const reference::RadiositySettings& settings);  // of mode radiosity, before it is shown
    void setHeadlight(float irradiance);  // of modes of the renderer (Renderer::setHeadlight)
    void redraw();  // the next draw draws although nothing changed, and although only single frames are asked
    bool drawing() const;         // a picture is begun and not finished, or other work for it
    bool works() const;           // a piece of it goes on beside the window
    void drop();                  // what is drawn is not wanted; the next draw begins anew
    std::string work() const;     // what drawing is at: "voxelize: mark", "textures, 4 of 30"; empty: nothing
    std::uint64_t parts() const;  // grows with every part of a picture, and with every picture
    void blank();                 // shows nothing until the next draw
    // Frees what the slot holds; the next draw starts anew.
    void clear();
    std::vector<std::string> reloadShaders();  // messages of those that fail

    // Whether what changed since the last picture can be shown without rendering: exposure, tone map.
    bool onlyLook(const Session& session) const;
    std::uint32_t texture() const;  // tone-mapped, row 0 on top; 0: nothing yet
    int width() const;
    int height() const;
    // Reads it back when it has not been yet; empty: there is no picture.
    const Image& linear();
    double frameMs() const;           // of the last frame that was drawn
    double pixelsMs() const;          // the part of it that is not the light cache's
    std::uint64_t version() const;    // grows with every new picture
    const FrameStats* stats() const;  // of the last frame of a renderer's mode; null without
    bool ownPicture() const;          // what is shown is the mode's and of this view, not a preview, nor old
    bool finished() const;            // ownPicture, and nothing would refine it
    std::string label() const;        // mode, and how far it is

    // What a pixel of a renderer's mode gathered; other modes cannot say. The first time builds programs.
    bool inspects() const;
    PixelInspection inspectPixel(const glm::ivec2& pixel);  // throws what the renderer throws
    // The same beside the window, which takes it later; empty when the picture has another size by then.
    void beginInspection(const glm::ivec2& pixel);
    std::optional<PixelInspection> takeInspection();

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace conelight::program
