// SPDX-License-Identifier: MIT
#include "viewer/file_watch.h"

#include <algorithm>
#include <system_error>

namespace conelight::program {
namespace {
constexpr std::chrono::milliseconds kPeriod{500};
}

FileWatch::Time FileWatch::newestIn(const std::string& path) {
    Time newest = kNever;
    std::error_code error;
    if (path.empty()) return newest;
    if (!std::filesystem::is_directory(path, error)) {
        const Time time = std::filesystem::last_write_time(path, error);
        return error ? newest : time;
    }
    for (std::filesystem::recursive_directory_iterator it(path, error), end; !error && it != end;
         it.increment(error)) {
        const Time time = it->last_write_time(error);
        if (!error) newest = std::max(newest, time);
    }
    return newest;
}

bool FileWatch::due(std::chrono::steady_clock::time_point& last) {
    const auto now = std::chrono::steady_clock::now();
    if (now - last < kPeriod) return false;
    last = now;
    return true;
}

void FileWatch::setScene(const std::string& path) {
    if (path == scene_) return;
    scene_ = path;
    sceneTime_ = newestIn(path);
}

void FileWatch::acceptScene() { sceneTime_ = newestIn(scene_); }

bool FileWatch::sceneChanged() {
    if (scene_.empty() || !due(sceneLooked_)) return false;
    const Time time = newestIn(scene_);
    if (time == kNever || time == sceneTime_) return false;
    // A file that is still being written is left alone until it has rested for a period.
    const bool atRest = Time::clock::now() - time > kPeriod;
    if (atRest) sceneTime_ = time;
    return atRest;
}

bool FileWatch::shadersChanged() {
    if (shaders_.empty() || !due(shadersLooked_)) return false;
    const Time time = newestIn(shaders_);
    const bool changed = shaderTime_ != kNever && time != shaderTime_;
    shaderTime_ = time;
    return changed;
}

}  // namespace conelight::program
