// SPDX-License-Identifier: MIT
// Radiosity baked in a thread of its own while the window stays live.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "session/session.h"

namespace conelight::program {

struct BakeStatus {
    double done = 0;          // part of the work
    double secondsLeft = -1;  // < 0: unknown
    bool running = false;
    std::string error;  // of the thread; empty: none
};

class BackgroundBake {
  public:
    BackgroundBake();
    ~BackgroundBake();  // stops and waits
    BackgroundBake(const BackgroundBake&) = delete;
    BackgroundBake& operator=(const BackgroundBake&) = delete;

    // Bakes the session's scene, anew when it changed. Cheap to call every frame; never waits. `wake` is
    // called from the thread when there is progress.
    void bake(const Session& session, void (*wake)());
    void stop();  // asks the thread to end; the lit scene is gone

    // The lit scene that was finished last, of the session's scene as it was then; null: none yet.
    std::shared_ptr<const Scene> lit(const Session& session) const;
    bool current(const Session& session) const;  // lit() is of the scene as it is now
    BakeStatus status() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace conelight::program
