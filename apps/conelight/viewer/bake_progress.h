// SPDX-License-Identifier: MIT
// How far a bake in another thread is. That thread reports through bakeWatcher(), the window reads the status.
#pragma once

#include <functional>
#include <mutex>
#include <string>

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

// What a bake reports to: `status`, guarded by `mutex`, is kept up to date, the window woken at each step, and the
// bake ends when it is cancelled. All outlive the bake.
struct BakeWatch {
    const Cancelled& cancelled;
    std::mutex& mutex;
    BakeStatus& status;
    void (*wake)();
};
std::function<bool(const reference::RadiosityProgress&)> bakeWatcher(const BakeWatch& watch);

// Seconds in a small room, to have something to show: a quarter of the rays. Chosen by eye.
reference::RadiositySettings draftOf(reference::RadiositySettings settings);

}  // namespace conelight::program
