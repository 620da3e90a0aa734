// SPDX-License-Identifier: MIT
#include "modes/memory_fit.h"

#include <algorithm>

#include "conelight/memory.h"
#include "voxels/voxels.h"

namespace conelight::modes {
namespace {

constexpr int kFewestVoxels = 16;
constexpr int kSmallestMaps = 64;
// Of modes other than traced they are all that makes shadows: smaller ones go along with larger voxels.
constexpr int kLargeMaps = 512;
// With fewer voxels than these a picture says so little that its past goes first.
constexpr int kFewVoxels = 32;

bool hasConeVolume(const Settings& settings) {
    return settings.mode == Mode::Cones || settings.mode == Mode::Hybrid;
}

// What costs the picture least comes first: the octree draws the same one, and rays make edges of shadows exact.
bool lowerOnce(Settings& settings) {
    if (hasConeVolume(settings) && settings.cones.storage == VolumeStorage::Dense) {
        settings.cones.storage = VolumeStorage::Octree;
        return true;
    }
    if (settings.light.shadowSize > kLargeMaps) {
        settings.light.shadowSize = kLargeMaps;
        return true;
    }
    if (settings.image.temporal == Toggle::On && settings.voxels.size <= kFewVoxels) {
        settings.image.temporal = Toggle::Off;
        return true;
    }
    int& voxels = settings.voxels.size;
    int& maps = settings.light.shadowSize;
    if (voxels <= kFewestVoxels && maps <= kSmallestMaps) return false;
    if (voxels > kFewestVoxels) voxels = std::max(voxels * 3 / 4 / 4 * 4, kFewestVoxels);
    if (maps > kSmallestMaps) maps = std::max(maps * 3 / 4 / 8 * 8, kSmallestMaps);
    return true;
}

void say(std::string& text, const char* key, const std::string& now, const std::string& asked) {
    if (now != asked)
        text += (text.empty() ? "" : ", ") + std::string(key) + " " + now + " instead of " + asked;
}

}  // namespace

Settings MemoryFit::lowered(const Settings& settings, int steps) {
    Settings less = settings;
    for (int step = 0; step < steps; ++step) lowerOnce(less);
    return less;
}

Settings MemoryFit::fitted(const Settings& settings, int width, int height) {
    const Work work{settings.mode, voxels::withoutAnchor(settings.voxels), settings.light, width, height,
                    memoryLimit()};
    if (!(work == work_)) steps_ = 0;
    work_ = work;
    return lowered(settings, steps_);
}

bool MemoryFit::lower(const Settings& settings) {
    if (lowered(settings, steps_ + 1) == lowered(settings, steps_)) return false;
    ++steps_;
    return true;
}

std::string MemoryFit::text(const Settings& settings) const {
    const Settings less = lowered(settings, steps_);
    std::string text;
    for (const char* key : {"voxels.size", "light.shadow_size", "cones.storage", "image.temporal"})
        say(text, key, getSetting(less, key), getSetting(settings, key));
    return text;
}

}  // namespace conelight::modes
