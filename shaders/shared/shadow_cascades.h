// SPDX-License-Identifier: MIT
// Maps of directional lights about the eye (view/shadow_cascades.h), for lib/shadow_cascades.glsl. Storage block
// CascadeTable: the constants, then `levels` cascades for each directional light of the table.
#pragma once
#include "shared/prelude.h"
CONELIGHT_SHARED_BEGIN

struct CascadeConstants {
    vec3 middle;  // what the levels lie about
    uint levels;
    // ---- 16 B
    float inverseNearest;  // 1/m: of the distance that level 0 serves
    float perDoubling;     // levels for each doubling of the distance
    float inverseDepth;    // of the distance along the light in that across it
    uint pad0;
};  // 32 B

// As ParallelMap of light/shadow_layout.h.
struct Cascade {
    vec3 position;
    float shadowNear;
    // ---- 16 B
    float texel;
    int layer;  // -1: the light casts no shadow
    uint pad0, pad1;
};  // 32 B

CONELIGHT_SHARED_END
#ifdef __cplusplus
static_assert(sizeof(conelight::gpu::CascadeConstants) == 32);
static_assert(sizeof(conelight::gpu::Cascade) == 32);
#endif
