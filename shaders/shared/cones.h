// SPDX-License-Identifier: MIT
// What the passes that trace cones are told; filled by src/gather/cone_gather.cpp.
#pragma once
#include "shared/prelude.h"

#define MAX_CONES 64  // src/gather/cone_set.h

// Counters of lookups (texture fetches), in the order of Frame::lookupCounters.
#define LOOKUPS_DIFFUSE 0
#define LOOKUPS_SPECULAR 1
#define LOOKUPS_OCCLUSION 2

CONELIGHT_SHARED_BEGIN

struct ConeConstants {
    uint count;         // cones in use
    float step;         // of the footprint
    float offset;       // m, along the geometric normal
    float maxDistance;  // m
    // ---- 16 B
    float specularMinTan;     // tangent of half the narrowest aperture
    float occlusionDistance;  // m
    float shadowTan;          // tangent of half the aperture of cones to lights
    uint pad0;
    // ---- 32 B
    vec4 cone[MAX_CONES];      // xyz direction about +z, w weight / pi
    vec4 aperture[MAX_CONES];  // x tangent of the half-angle
};                             // 2080 B

CONELIGHT_SHARED_END
#ifdef __cplusplus
static_assert(sizeof(conelight::gpu::ConeConstants) == 2080);
#endif
