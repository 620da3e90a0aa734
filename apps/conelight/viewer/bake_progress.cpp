// SPDX-License-Identifier: MIT
#include "viewer/bake_progress.h"

#include <algorithm>
#include <exception>

#include "viewer/background_job.h"

namespace conelight::program {
namespace {

reference::RadiositySettings draftOf(reference::RadiositySettings settings) {
    settings.maxSubdivision = std::min(settings.maxSubdivision, 3);
    settings.patchRays = std::min(settings.patchRays, 128);
    settings.gatherRays = std::min(settings.gatherRays, 128);
    settings.visibilityRays = std::min(settings.visibilityRays, 64);
    return settings;
}

}  // namespace

BakeReport bakeWatcher(const BakeWatch& watch) {
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

void bakeTwice(const BakeWatch& watch, const reference::RadiositySettings& full, const BakeStep& bake) {
    for (const bool draft : {true, false}) {
        std::string failure;
        std::function<void()> keep;
        try {
            reference::RadiositySettings chosen = draft ? draftOf(full) : full;
            chosen.threads = BackgroundJob::threads();
            keep = bake(chosen, bakeWatcher(watch));
        } catch (const std::exception& error) {
            failure = error.what();
        }
        if (watch.cancelled) return;  // half a bake is none
        {
            const std::lock_guard lock(watch.mutex);
            watch.status = {};
            watch.status.running = watch.status.refining = draft && failure.empty();
            watch.status.error = failure;
            if (!failure.empty()) return;
            keep();
        }
        watch.wake();
    }
}

}  // namespace conelight::program
