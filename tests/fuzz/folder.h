// SPDX-License-Identifier: MIT
// A folder per process for readers that take a path, in memory where there is such a file system. tools/fuzz
// removes it.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <string>

namespace conelight::fuzz {

inline const std::filesystem::path& folder() {
    static const std::filesystem::path kFolder = [] {
        const std::filesystem::path base =
            std::filesystem::exists("/dev/shm") ? "/dev/shm" : std::filesystem::temp_directory_path();
        std::filesystem::path made = base / ("conelight_fuzz_" + std::to_string(getpid()));
        std::filesystem::create_directories(made);
        return made;
    }();
    return kFolder;
}

}  // namespace conelight::fuzz
