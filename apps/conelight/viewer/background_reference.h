// SPDX-License-Identifier: MIT
// The path tracer refining a picture, or the beam tracer making one, in a thread of its own while the window stays
// live.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "conelight/renderer.h"
#include "session/session.h"

namespace conelight::program {

struct ReferenceStatus {
    int samplesPerPixel = 0;
    double noise = 0;  // estimated relRMSE
    bool running = false;
    std::string error;  // of the thread; empty: none
};

class BackgroundReference {
  public:
    enum class Method : std::uint8_t { Paths, Beams };
    explicit BackgroundReference(Method method = Method::Paths);
    ~BackgroundReference();  // stops and waits
    BackgroundReference(const BackgroundReference&) = delete;
    BackgroundReference& operator=(const BackgroundReference&) = delete;

    // Refines the session's view of `width` x `height` pixels, anew when scene, camera, component or size
    // changed, until `samplesPerPixel`, which beams do not need. Cheap to call every frame; never waits. `wake` is called from the
    // thread after each round.
    void refine(const Session& session, int width, int height, int samplesPerPixel, void (*wake)());
    void stop();  // asks the thread to end; its picture is gone

    // Whether what it holds or is about to hold is the session's view now.
    bool shows(const Session& session) const;
    std::uint64_t jobs() const;  // how many pictures were begun: which one it is
    // Copies the newest picture when there is one newer than `version`, which it then sets.
    bool take(std::uint64_t& version, Image& picture);
    ReferenceStatus status() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace conelight::program
