// SPDX-License-Identifier: MIT
// Light of mode hybrid, baked in a thread of its own while the window stays live.
#pragma once

#include <memory>

#include "reference/radiosity.h"
#include "session/session.h"
#include "viewer/bake_progress.h"

namespace conelight::program {

class BackgroundStaticBake {
  public:
    BackgroundStaticBake();
    ~BackgroundStaticBake();  // stops and waits
    BackgroundStaticBake(const BackgroundStaticBake&) = delete;
    BackgroundStaticBake& operator=(const BackgroundStaticBake&) = delete;

    // Bakes what does not move in the session's scene, anew when that changed: a draft, then in full. Cheap to call
    // every frame; never waits. `wake` is called from the thread when there is progress.
    void bake(const Session& session, void (*wake)());
    void setSettings(const reference::RadiositySettings& settings);  // of bakes that begin from now on
    void stop();  // asks the thread to end; the light is gone

    // The light that was finished last, of the session's scene as it was then; null: none yet.
    std::shared_ptr<const BakedLight> light(const Session& session) const;
    BakeStatus status() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace conelight::program
