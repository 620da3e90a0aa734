// SPDX-License-Identifier: MIT
// How far a bake in another thread is. That thread bakes through bakeWatched(), the window reads status().
#pragma once

#include <mutex>
#include <string>

#include "conelight/scene.h"
#include "reference/radiosity.h"
#include "viewer/background_job.h"

namespace conelight::program {

struct BakeStatus {
    double done = 0;          // part of the work
    double secondsLeft = -1;  // < 0: unknown
    bool running = false;
    bool refining = false;  // a draft is there
    std::string error;      // of the thread; empty: none
};

// bakeRadiosity that keeps `status`, guarded by `mutex`, up to date, wakes the window at each step and ends
// when it is cancelled. Throws what bakeRadiosity throws.
Scene bakeWatched(const Scene& scene, const reference::RadiositySettings& settings,
                  const Cancelled& cancelled, std::mutex& mutex, BakeStatus& status, void (*wake)());

}  // namespace conelight::program
