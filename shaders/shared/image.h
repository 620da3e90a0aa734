// SPDX-License-Identifier: MIT
// What the image stage's passes are told.
#pragma once
#include "shared/prelude.h"

CONELIGHT_SHARED_BEGIN

// Uniform block at BINDING_PASS of image/display.comp.glsl.
struct DisplayConstants {
    float scale;  // 2^exposure
    uint curve;   // ToneMap: 0 none, 1 Reinhard, 2 ACES
    uint srgb;    // encode
    uint pad0;
};  // 16 B

CONELIGHT_SHARED_END
#ifdef __cplusplus
static_assert(sizeof(conelight::gpu::DisplayConstants) == 16);
#endif
