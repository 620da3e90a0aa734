// SPDX-License-Identifier: MIT
// What shaders know of the lights besides their table. Uniform block LightingBlock, of light/lights.h.
#pragma once
#include "shared/prelude.h"
CONELIGHT_SHARED_BEGIN

struct LightingConstants {
    vec3 sky;                // constant radiance where nothing is hit, W/(sr m^2)
    float environmentScale;  // radiance of a texel value of 1, W/(sr m^2)
    // ---- 16 B: the light table is sorted by type; ends of the ranges of point, spot, directional, rect
    uvec4 lightEnds;
    // ---- 32 B: the environment's picture (lib/environment.glsl)
    float environmentTurn;  // its rotation, turns
    float
        environmentInverseFlux;  // 1 over the sum of brightness times solid angle of its cells, in texel values
    float environmentLevel0;     // log2 of its width
    float environmentCellLevel;  // the level whose texels are the cells that rays are drawn in
};                               // 48 B

CONELIGHT_SHARED_END
#ifdef __cplusplus
static_assert(sizeof(conelight::gpu::LightingConstants) == 48);
#endif
