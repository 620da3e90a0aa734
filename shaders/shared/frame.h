// SPDX-License-Identifier: MIT
// What every pass of a frame may ask: camera, picture size, scene counts. Uniform block at BINDING_FRAME.
#pragma once
#include "shared/prelude.h"
CONELIGHT_SHARED_BEGIN

struct FrameConstants {
    mat4 clipFromWorld;
    mat4 worldFromClip;
    // ---- 128 B
    vec3 eye;
    float zNear;
    // ---- 144 B
    vec3 sky;  // radiance where nothing is hit
    float zFar;
    // ---- 160 B
    uint width;
    uint height;
    uint lightCount;
    uint frameIndex;
    // ---- 176 B
    uint instanceCount;
    uint triangleCount;  // of all instances
    uint seed;
    uint pad0;
    // ---- 192 B: the point at view depth z and clip position (x, y) is eye + z (viewForward + x viewRight +
    // y viewUp)
    vec3 viewForward;  // unit
    float pad1;
    vec3 viewRight;  // unit vector times the tangent of half the horizontal field of view
    float pad2;
    vec3 viewUp;  // unit vector times the tangent of half the vertical field of view
    float pad3;
    // ---- 240 B: the light table is sorted by type; ends of the ranges of point, spot, directional, rect
    uvec4 lightEnds;
};  // 256 B

CONELIGHT_SHARED_END
#ifdef __cplusplus
static_assert(sizeof(conelight::gpu::FrameConstants) == 256);
#endif
