// SPDX-License-Identifier: MIT
#include "viewer/timings.h"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <ctime>

namespace conelight::program {
namespace {

double threadCpuMs() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

double steadyMs() {
    using clock = std::chrono::steady_clock;
    return std::chrono::duration<double, std::milli>(clock::now().time_since_epoch()).count();
}

}  // namespace

bool Timings::noteFirstPicture() {
    if (firstPictureMs_ >= 0) return false;
    firstPictureMs_ = steadyMs() - startedMs_;
    return true;
}

std::string Timings::firstPictureText() const {
    return fmt::format("timing: first frame after {:.2f} s", 1e-3 * firstPictureMs_);
}

void Timings::beginGui() { guiBeganMs_ = threadCpuMs(); }
void Timings::endGui() { gui_.add(threadCpuMs() - guiBeganMs_); }

void Timings::beginLook() {
    if (lookedMs_ < 0) return;
    pauses_.longestMs = std::max(pauses_.longestMs, steadyMs() - lookedMs_);
    ++pauses_.looks;
}
void Timings::endLook() { lookedMs_ = steadyMs(); }

std::string Timings::summary(const FrameTimes& pictures) const {
    return fmt::format(
        "timing: GUI {:.3f} ms of CPU a frame, picture {:.1f} ms (medians of the last {} and {} frames)",
        gui_.median(), pictures.median(), gui_.all().size(), pictures.all().size());
}

}  // namespace conelight::program
