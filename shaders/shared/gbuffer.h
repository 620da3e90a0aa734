// SPDX-License-Identifier: MIT
// Depths of the G-buffer: those of surfaces end before that of the background (1), so that a pass over the
// picture may ask the depth test where a surface is. Drivers skip the other pixels, where a branch or a
// discard in a shader spares a software driver nothing.
#pragma once
#include "shared/prelude.h"

#define GBUFFER_FARTHEST 0.9999847f  // 1 - 2^-16: far above rounding, and depths keep their order
#define GBUFFER_BEHIND 0.9999924f    // 1 - 2^-17: behind all surfaces, before the background

CONELIGHT_SHARED_BEGIN

// Uniform block of view/shrink.geom.glsl.
struct ShrinkConstants {
    float kept;  // of each triangle's extent, 0..1
    uint pad0;
    uint pad1;
    uint pad2;
};  // 16 B

CONELIGHT_SHARED_END
#ifdef __cplusplus
static_assert(sizeof(conelight::gpu::ShrinkConstants) == 16);
#endif
