// SPDX-License-Identifier: MIT
// What shaders know of the lights besides their table. Uniform block LightingBlock, of light/lights.h.
#pragma once
#include "shared/prelude.h"
CONELIGHT_SHARED_BEGIN

struct LightingConstants {
    vec3 sky;  // radiance where nothing is hit, W/(sr m^2)
    float pad0;
    // ---- 16 B: the light table is sorted by type; ends of the ranges of point, spot, directional, rect
    uvec4 lightEnds;
};  // 32 B

CONELIGHT_SHARED_END
#ifdef __cplusplus
static_assert(sizeof(conelight::gpu::LightingConstants) == 32);
#endif
