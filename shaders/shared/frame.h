// SPDX-License-Identifier: MIT
// The eye: camera and picture size. Uniform block FrameBlock.
#pragma once
#include "shared/prelude.h"
CONELIGHT_SHARED_BEGIN

struct FrameConstants {
    mat4 clipFromWorld;  // z of a host's parallel rays: view depth
    // ---- 64 B
    vec3 eye;
    uint width;
    // ---- 80 B: the point at view depth z and clip position (x, y) is eye + z (viewForward + x viewRight +
    // y viewUp); of parallel rays eye + x viewRight + y viewUp + z viewForward
    vec3 viewForward;  // unit, where pixels are seen at their centres
    uint height;
    vec3
        viewRight;  // unit vector times the tangent of half the horizontal field of view; of parallel rays half the
                    // picture's width, m
    float footprint;  // edge of the part of a pixel that this view stands for, pixels: textures are as sharp
    vec3 viewUp;      // unit vector times the tangent of half the vertical field of view
    // Which fragments of blended surfaces are there: below 0 those that hide a half and more, in [0,1) those above
    // thresholds that this number turns, 2 those above thresholds that differ within each 3 x 3 pixels.
    float blending;
    // ---- 128 B
    float parallel;  // 1: rays are parallel; 0: they meet in the eye
    float pad0;
    float pad1;
    float pad2;
};  // 144 B

CONELIGHT_SHARED_END
#ifdef __cplusplus
static_assert(sizeof(conelight::gpu::FrameConstants) == 144);
#endif
