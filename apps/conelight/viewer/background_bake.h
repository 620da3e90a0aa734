// SPDX-License-Identifier: MIT
// Radiosity baked in a thread of its own while the window stays live.
#pragma once

#include <cstdint>
#include <memory>

#include "reference/radiosity.h"
#include "session/session.h"
#include "viewer/bake_progress.h"

namespace conelight::program {

class BackgroundBake {
  public:
    BackgroundBake();
    ~BackgroundBake();  // stops and waits
    BackgroundBake(const BackgroundBake&) = delete;
    BackgroundBake& operator=(const BackgroundBake&) = delete;

    // Bakes the session's scene, anew when it changed. Cheap to call every frame; never waits. `wake` is
    // called from the thread when there is progress.
    void bake(const Session& session, void (*wake)());
    void setSettings(const reference::RadiositySettings& settings);  // of bakes that begin from now on
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
