// SPDX-License-Identifier: MIT
#include "viewer/background_load.h"

#include <fmt/core.h>

#include <utility>

#include "conelight/memory.h"

namespace conelight::program {
namespace {

constexpr std::chrono::milliseconds kTold{50};  // between looks of the window at how far a load is

}  // namespace

bool BackgroundLoad::tell(const io::LoadStep& step, const Cancelled& cancelled, void (*wake)()) {
    const auto now = std::chrono::steady_clock::now();
    bool shows = false;
    {
        const std::lock_guard lock(mutex_);
        shows = progress_.step != step.name || now - told_ > kTold;
        if (shows) {
            progress_ = {std::string(step.name), step.done, step.total};
            told_ = now;
        }
    }
    if (shows) wake();
    return !cancelled;
}

void BackgroundLoad::run(const Read& read, const Cancelled& cancelled, void (*wake)()) {
    TakeOver takeOver;
    std::exception_ptr failure;
    try {
        io::LoadOptions watched;
        watched.progress = [&](const io::LoadStep& step) { return tell(step, cancelled, wake); };
        takeOver = read(watched);
    } catch (...) {
        failure = std::current_exception();
    }
    const std::lock_guard lock(mutex_);
    takeOver_ = std::move(takeOver);
    failure_ = failure;
}

bool BackgroundLoad::start(const std::string& name, Read read, void (*wake)()) {
    if (job_.busy()) return false;
    name_ = name;
    started_ = true;
    stopped_ = false;
    progress_ = {};
    takeOver_ = nullptr;
    failure_ = nullptr;
    if (memoryLimit() > 0)
        run(read, false, wake);
    else
        job_.start(
            [this, read = std::move(read), wake](const Cancelled& cancelled) { run(read, cancelled, wake); },
            wake);
    return true;
}

void BackgroundLoad::stop() {
    if (!started_) return;
    stopped_ = true;
    job_.cancel();
}

BackgroundLoad::Status BackgroundLoad::status() const {
    const std::lock_guard lock(mutex_);
    const std::string name = name_ + ": " + progress_.step;
    if (progress_.total == 0) return {name, -1};
    return {fmt::format("{}, {} of {}", name, progress_.done, progress_.total),
            static_cast<double>(progress_.done) / static_cast<double>(progress_.total)};
}

bool BackgroundLoad::finish() {
    if (!started_ || job_.busy()) return false;
    started_ = false;
    const TakeOver takeOver = std::exchange(takeOver_, nullptr);
    const std::exception_ptr failure = std::exchange(failure_, nullptr);
    if (stopped_) throw io::LoadStopped(name_ + ": stopped; nothing is loaded");
    if (failure) std::rethrow_exception(failure);
    takeOver();
    return true;
}

}  // namespace conelight::program
