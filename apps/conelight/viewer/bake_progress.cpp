// SPDX-License-Identifier: MIT
#include "viewer/bake_progress.h"

namespace conelight::program {

Scene bakeWatched(const Scene& scene, const reference::RadiositySettings& settings,
                  const Cancelled& cancelled, std::mutex& mutex, BakeStatus& status, void (*wake)()) {
    const auto report = [&](const reference::RadiosityProgress& progress) {
        if (cancelled) return false;
        {
            const std::lock_guard lock(mutex);
            status.done = progress.done;
            status.secondsLeft = progress.secondsLeft;
        }
        wake();
        return true;
    };
    return reference::bakeRadiosity(scene, settings, nullptr, report);
}

}  // namespace conelight::program
