// SPDX-License-Identifier: MIT
// What the qualities of mode `traced` cost and what they give: what --help, the console and the documentation
// say of them.
#pragma once

#include <string>
#include <vector>

#include "conelight/settings.h"

namespace conelight {

struct QualityInfo {
    Quality quality = Quality::Interactive;
    std::string name;      // as traced.quality takes it
    int raysPerPixel = 0;  // for matt indirect light, over all passes; 0: the cache of the faces is shown
    int lobeRays = 0;      // per pixel into the lobes of smooth surfaces, over all passes
    int raysPerFace = 0;   // of the cache, over all updates
    // Indirect light of builtin:cornell against the path tracer's, as `conelight compare builtin:cornell
    // --modes traced --vary traced.quality=... --against reference --size 256x256 --spp 256` measures it.
    double relativeError = 0;  // RMS / mean
    double bias = 0;           // mean / mean of the reference - 1
};

// In the order of Quality. Counts are those of applyQuality; errors were measured.
std::vector<QualityInfo> qualityInfos();

// "32 rays a pixel, 128 a voxel face; error of indirect light 4.9 %, bias -0.1 %"
std::string qualityText(const QualityInfo& info);

}  // namespace conelight
