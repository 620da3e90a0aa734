// SPDX-License-Identifier: MIT
// What the qualities of mode `traced` cost, computed from applyQuality: what --help and the console say of
// them. How far their pictures are from the path tracer's is in docs/measurements/modes_vs_reference.md.
#pragma once

#include <string>
#include <vector>

#include "conelight/export.h"
#include "conelight/settings.h"

namespace conelight {

struct QualityInfo {
    Quality quality = Quality::Interactive;
    std::string name;      // as traced.quality takes it
    int raysPerPixel = 0;  // for diffuse indirect light, over all passes; 0: the cache of the faces is shown
    int lobeRays = 0;      // per pixel into the specular lobe, over all passes
    int raysPerFace = 0;   // of the cache, over all updates
};

// In the order of Quality.
CONELIGHT_API std::vector<QualityInfo> qualityInfos();

// "32 rays a pixel, 128 a voxel face"
CONELIGHT_API std::string qualityText(const QualityInfo& info);

}  // namespace conelight
