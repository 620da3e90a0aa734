// SPDX-License-Identifier: MIT
// The qualities of mode `traced` as functions that fill in its settings, and what each costs.
#include "conelight/quality.h"

#include <utility>

#include "base/log.h"

namespace conelight {
namespace {

constexpr std::pair<const char*, Quality> kQualities[] = {{"draft", Quality::Draft},
                                                          {"interactive", Quality::Interactive},
                                                          {"high", Quality::High},
                                                          {"converged", Quality::Converged}};

TracedSettings settingsOf(Quality quality) {
    TracedSettings s;  // interactive
    switch (quality) {
        case Quality::Draft:
            s.pixelRays = 0;
            s.specularLimit = 0.4f;
            s.passes = 4;
            s.filterLevels = 1;
            s.cacheUpdates = 48;
            s.exactMirrors = s.exactShadows = false;
            break;
        case Quality::Interactive:
            break;
        case Quality::High:
            s.pixelRays = 4;
            s.specularRays = 2;
            s.specularLimit = 1;
            s.cacheUpdates = 64;
            break;
        case Quality::Converged:
            s.pixelRays = 8;
            s.filterLevels = 2;
            s.specularRays = 8;
            s.specularLimit = 1;
            s.cacheRays = 8;
            s.cacheUpdates = 46;
            break;
    }
    return s;
}

}  // namespace

void applyQuality(TracedSettings& settings, Quality quality) {
    TracedSettings filled = settingsOf(quality);
    filled.reduction = settings.reduction;
    filled.bounces = settings.bounces;
    filled.budgeted = settings.budgeted;
    settings = filled;
}

std::optional<Quality> qualityOf(const TracedSettings& settings) {
    for (const auto& [name, quality] : kQualities) {
        TracedSettings filled = settings;
        applyQuality(filled, quality);
        if (filled == settings) return quality;
    }
    return std::nullopt;
}

std::vector<QualityInfo> qualityInfos() {
    std::vector<QualityInfo> infos;
    for (const auto& [name, quality] : kQualities) {
        const TracedSettings s = settingsOf(quality);
        // As many light-sampled rays as cosine-sampled ones.
        infos.push_back({quality, name, 2 * s.pixelRays * s.passes, s.specularRays * s.passes,
                         2 * s.cacheRays * s.cacheUpdates});
    }
    return infos;
}

std::string qualityText(const QualityInfo& info) {
    return base::format("%d rays a pixel, %d a voxel face", info.raysPerPixel, info.raysPerFace);
}

}  // namespace conelight
