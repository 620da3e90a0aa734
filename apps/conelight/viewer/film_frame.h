// SPDX-License-Identifier: MIT
// A frame of a film in mode reference: the path tracer in a thread of its own, bit for bit the picture that
// `conelight render --mode reference` draws of the same view.
#pragma once

#include <glm/glm.hpp>
#include <memory>

#include "reference/path_tracer.h"
#include "session/session.h"

namespace conelight::program {

class FilmFrame {
  public:
    FilmFrame();
    ~FilmFrame();  // stops and waits
    FilmFrame(const FilmFrame&) = delete;
    FilmFrame& operator=(const FilmFrame&) = delete;

    // The session's view as it is now. False while a picture before is still ending: ask again later. Scenes
    // are kept from frame to frame. `wake` is called from the thread when it is done.
    bool start(const Session& session, const glm::ivec2& size, const reference::PathTracerSettings& settings,
               void (*wake)());
    bool ready() const;   // take() would return the picture that was started
    double done() const;  // of it, 0..1
    Image take();         // throws Error(Runtime) when there is none
    void stop();          // asks the thread to end; never waits

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace conelight::program
