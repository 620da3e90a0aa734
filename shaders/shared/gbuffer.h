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

// Storage MotionTable of view/motion.vert.glsl, per instance: where it was in the picture before.
struct InstanceMotion {
    mat4 worldFromObject;
    // ---- 64 B
    uint firstVertex;  // of its mesh in VerticesBefore, or MOTION_*
    uint pad0;
    uint pad1;
    uint pad2;
};                                     // 80 B
#define MOTION_SAME_SHAPE 0xffffffffu  // its vertices are those of the picture before
#define MOTION_UNKNOWN 0xfffffffeu     // nobody knows where they were

CONELIGHT_SHARED_END
#ifdef __cplusplus
static_assert(sizeof(conelight::gpu::ShrinkConstants) == 16);
static_assert(sizeof(conelight::gpu::InstanceMotion) == 80);
#endif
