// SPDX-License-Identifier: MIT
// A picture drawn by a process of its own, `conelight render`, and what that took from its start to its end.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "conelight/renderer.h"

namespace conelight::program {

// A folder of its own among the temporary ones, gone with it.
class ScratchFolder {
  public:
    ScratchFolder();  // throws Error(Runtime)
    ~ScratchFolder();
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;
    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

struct ChildPicture {
    Image image;            // linear radiance
    std::string command;    // as one would type it
    double cpuSeconds = 0;  // user and system time of the process: start, loading, drawing and writing
};

// `words`: of `render`, without --output. Throws Error(Runtime) with the last line of what it said when it fails,
// InterruptedError after a signal.
ChildPicture drawInChild(const std::vector<std::string>& words, const ScratchFolder& folder);

}  // namespace conelight::program
