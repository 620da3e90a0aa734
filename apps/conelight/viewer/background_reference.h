// SPDX-License-Identifier: MIT
// The path tracer refining a picture in a thread of its own while the window stays live.
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
    BackgroundReference();
    ~BackgroundReference();  // stops and joins
    BackgroundReference(const BackgroundReference&) = delete;
    BackgroundReference& operator=(const BackgroundReference&) = delete;

    // Refines the session's view of `width` x `height` pixels, anew when scene, camera, sky or size changed,
    // until `samplesPerPixel`. Cheap to call every frame. `wake` is called from the thread after each round.
    void refine(const Session& session, int width, int height, int samplesPerPixel, void (*wake)());
    void stop();

    // Copies the newest picture when there is one newer than `version`, which it then sets.
    bool take(std::uint64_t& version, Image& picture);
    ReferenceStatus status() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace conelight::program
