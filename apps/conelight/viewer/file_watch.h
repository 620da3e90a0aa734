// SPDX-License-Identifier: MIT
// Files that changed on disk since they were last looked at: the scene's, and the shaders of --shader-dir.
// Modification times are polled, at most twice a second.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>

namespace conelight::program {

class FileWatch {
  public:
    explicit FileWatch(std::string shaderDirectory) : shaders_(std::move(shaderDirectory)) {}
    void setScene(const std::string& path);  // what does not name a file (builtin:) is not watched
    void acceptScene();                      // as it is now, it is known
    bool sceneChanged();
    bool shadersChanged();

  private:
    using Time = std::filesystem::file_time_type;
    // Times of files may lie before the clock's own zero (libstdc++: the year 2174).
    static constexpr Time kNever = Time::min();
    static Time newestIn(const std::string& path);
    bool due(std::chrono::steady_clock::time_point& last);
    std::string scene_, shaders_;
    Time sceneTime_ = kNever, shaderTime_ = kNever;
    std::chrono::steady_clock::time_point sceneLooked_{}, shadersLooked_{};
};

}  // namespace conelight::program
