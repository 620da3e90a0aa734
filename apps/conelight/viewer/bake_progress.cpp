// SPDX-License-Identifier: MIT
#include "viewer/bake_progress.h"

#include <algorithm>

namespace conelight::program {

std::function<bool(const reference::RadiosityProgress&)> bakeWatcher(const BakeWatch& watch) {
    return [watch](const reference::RadiosityProgress& progress) {
        if (watch.cancelled) return false;
        {
            const std::lock_guard lock(watch.mutex);
            watch.status.done = progress.done;
            watch.status.secondsLeft = progress.secondsLeft;
        }
        watch.wake();
        return true;
    };
}

reference::RadiositySettings draftOf(reference::RadiositySettings settings) {
    settings.maxSubdivision = std::min(settings.maxSubdivision, 3);
    settings.patchRays = std::min(settings.patchRays, 128);
    settings.gatherRays = std::min(settings.gatherRays, 128);
    settings.visibilityRays = std::min(settings.visibilityRays, 64);
    return settings;
}

}  // namespace conelight::program
