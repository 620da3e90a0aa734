// SPDX-License-Identifier: MIT
#include "conelight/quality.h"

#include <cmath>
#include <cstdio>

namespace conelight {
namespace {

// Measured with the command in conelight/quality.h, November 2026; changes with the mode, so measure again.
struct Measured {
    const char* name;
    Quality quality;
    double relativeError, bias;
};
constexpr Measured kMeasured[] = {
    {"draft", Quality::Draft, 0.052, 0.003},
    {"interactive", Quality::Interactive, 0.038, 0.002},
    {"high", Quality::High, 0.024, 0.001},
    {"converged", Quality::Converged, 0.019, 0.001},
};

}  // namespace

std::vector<QualityInfo> qualityInfos() {
    std::vector<QualityInfo> infos;
    for (const Measured& one : kMeasured) {
        TracedSettings s;
        applyQuality(s, one.quality);
        // As many rays again go to bright faces as by the cosine.
        infos.push_back({one.quality, one.name, 2 * s.pixelRays * s.passes, s.specularRays * s.passes,
                         2 * s.cacheRays * s.cacheUpdates, one.relativeError, one.bias});
    }
    return infos;
}

std::string qualityText(const QualityInfo& info) {
    char text[160];
    std::snprintf(text, sizeof text,
                  "%d rays a pixel, %d a voxel face; error of indirect light %.1f %%, bias %+.1f %%",
                  info.raysPerPixel, info.raysPerFace, 100 * info.relativeError,
                  100 * (std::abs(info.bias) < 0.0005 ? 0.0 : info.bias));
    return text;
}

}  // namespace conelight
