// SPDX-License-Identifier: MIT
// What the image stage's passes are told.
#pragma once
#include "shared/prelude.h"

CONELIGHT_SHARED_BEGIN

// Uniform block of image/display.comp.glsl.
struct DisplayConstants {
    float scale;  // 2^exposure
    uint curve;   // ToneMap: 0 none, 1 Reinhard, 2 ACES
    uint srgb;    // encode
    uint pad0;
};  // 16 B

// Uniform block of image/wireframe.*.
struct WireframeConstants {
    vec3 radiance;
    float opacity;
    // ---- 16 B
    float halfWidth;  // pixels
    uint pad0;
    uint pad1;
    uint pad2;
};  // 32 B

// Uniform block of image/shadow_view.comp.glsl.
struct ShadowViewConstants {
    uint light;  // in the light table
    uint tiles;
    uint tilesPerEdge;  // of a layer
    uint columns;
    // ---- 16 B
    uint rows;
    uint pad0;
    uint pad1;
    uint pad2;
};  // 32 B

CONELIGHT_SHARED_END
#ifdef __cplusplus
static_assert(sizeof(conelight::gpu::DisplayConstants) == 16);
static_assert(sizeof(conelight::gpu::WireframeConstants) == 32);
static_assert(sizeof(conelight::gpu::ShadowViewConstants) == 32);
#endif
