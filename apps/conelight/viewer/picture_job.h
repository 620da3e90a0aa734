// SPDX-License-Identifier: MIT
// `screenshot` and `record` in the window: pictures drawn until they are finished and written, a little of
// the work between two frames of the window, so that it stays alive and can end it. Films of mode reference
// are traced in the background, those of mode radiosity begin when its bake is done.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "reference/path_tracer.h"
#include "session/session.h"
#include "video_file.h"
#include "viewer/film_frame.h"
#include "viewer/picture_slot.h"

namespace conelight::program {

class PictureJob {
  public:
    // A request of kind Screenshot or Record; pictures of `size` pixels unless it names others, films of mode reference
    // with these
    // settings for each. Not while busy(). Throws Error(Runtime) when nothing can be drawn or written there.
    void start(const Request& request, const Session& session, const glm::ivec2& size,
               const reference::PathTracerSettings& traced);
    bool busy() const { return request_.has_value(); }
    // Draws for a while. Returns the line that says what was written, once, when that was the last of it.
    // Throws what went wrong: then it has ended too. The camera is where it was when it ends.
    std::optional<std::string> step(Session& session, PictureSlot& slot);
    void stop() { stopped_ = true; }  // the next step ends it and says so

    const std::string& file() const { return request_->file; }
    int frames() const { return request_->count; }
    int done() const { return done_; }
    bool waits() const { return waits_ != WaitsFor::Nothing; }  // the last step drew nothing
    bool bakes() const { return waits_ == WaitsFor::Bake; }
    double part() const;         // of the whole work, 0..1
    double secondsLeft() const;  // < 0: unknown

  private:
    enum class WaitsFor : std::uint8_t { Nothing, PathTracer, Bake };  // in the background

    void end(Session& session);
    bool draw(Session& session, PictureSlot& slot);
    void add(const Session& session, const Image& linear);
    Image finished(PictureSlot& slot);

    std::optional<Request> request_;
    std::unique_ptr<VideoFile> video_;  // of films
    FilmFrame frame_;                   // mode reference
    reference::PathTracerSettings traced_;
    bool tracing_ = false;  // a frame of it was started
    WaitsFor waits_ = WaitsFor::Nothing;
    glm::ivec2 size_{0};
    bool whole_ = false;  // drawn for the file alone: to its end, also in modes of the background
    Camera camera_;       // where it stood at the start
    ClipState pose_;      // what was then
    int done_ = 0;
    bool placed_ = false;  // the camera is where the next frame wants it
    bool stopped_ = false;
    std::chrono::steady_clock::time_point began_;
};

}  // namespace conelight::program
