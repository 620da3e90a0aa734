// SPDX-License-Identifier: MIT
// Bakes in another thread, and how far they are. That thread reports through bakeWatcher(), the window reads the status.
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
using BakeReport = std::function<bool(const reference::RadiosityProgress&)>;
BakeReport bakeWatcher(const BakeWatch& watch);

// A draft first, a quarter of the rays (seconds in a small room; chosen by eye), then what `full` asks for. `bake` may
// throw, which ends both and is the status's error; what it returns takes the result, called under the mutex. The
// window is woken after each.
using BakeStep = std::function<std::function<void()>(const reference::RadiositySettings&, const BakeReport&)>;
void bakeTwice(const BakeWatch& watch, const reference::RadiositySettings& full, const BakeStep& bake);

}  // namespace conelight::program
