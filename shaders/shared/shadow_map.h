// SPDX-License-Identifier: MIT
// The shadow map being drawn. Uniform block ShadowMapBlock, of light/shadow_maps.cpp.
#pragma once
#include "shared/prelude.h"
CONELIGHT_SHARED_BEGIN

struct ShadowMapConstants {
    mat4 clipFromWorld;
    vec2 slopeUnit;  // a slope of 1 is slopeUnit.x + slopeUnit.y * depth, per texel
    vec2 middle;     // of the map, in texels of the layer
    // ---- 80 B
    vec2 halfSize;  // texels
    vec2 pad0;
};  // 96 B

CONELIGHT_SHARED_END
#ifdef __cplusplus
static_assert(sizeof(conelight::gpu::ShadowMapConstants) == 96);
#endif
