// SPDX-License-Identifier: MIT
// A scene file as every command takes it: read, given the camera and the light that it lacks, and checked.
#pragma once

#include <cstdlib>
#include <filesystem>

#include "conelight/error.h"
#include "conelight/scene.h"
#include "io/scene_file.h"

namespace conelight::fuzz {

// Throws Error when the file cannot be read. What is added to one that can must keep the scene's rules.
inline void loadComplete(const std::filesystem::path& file) {
    io::LoadOptions options;
    options.maxTexels = std::uint64_t(1) << 20;
    Scene scene = io::loadScene(file.string(), options);
    try {
        completeScene(scene);
        scene.validate();
    } catch (const Error&) {
        std::abort();
    }
    if (scene.cameras.empty()) std::abort();
}

}  // namespace conelight::fuzz
