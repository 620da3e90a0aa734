// SPDX-License-Identifier: MIT
// What the image stage's passes are told.
#pragma once
#include "shared/prelude.h"

// Automatic exposure: pixels are counted in four bins a stop (the upper bits of a float), from 2^-32 to 2^32.
#define EXPOSURE_BINS 256
#define EXPOSURE_SHIFT 21
#define EXPOSURE_FIRST 380u  // (127 - 32) * 4: the bin of 2^-32
#define EXPOSURE_LEAST 2.3283064e-10f
#define EXPOSURE_MOST 4.2949673e9f
#define EXPOSURE_DARKEST 10u    // one pixel in so many is left out, the darkest
#define EXPOSURE_BRIGHTEST 20u  // and one in so many, the brightest
#define EXPOSURE_GREY 0.18f     // what the mean becomes: middle grey
#define EXPOSURE_LIMIT 20.0f    // stops

// Checks of exposure: a colour per stop of luminance, below all, from -6 to 6, above all; stripes of so many pixels.
#define FALSE_COLORS 15
#define FALSE_COLOR_OFFSET 7.5f  // stops and this: the number of the colour
#define CLIPPING_STRIPE 4

CONELIGHT_SHARED_BEGIN

// Uniform block of passes that show a picture.
struct Exposure {
    float scale;  // 2^stops
    uint pad0;
    uint pad1;
    uint pad2;
};  // 16 B

// Uniform block of image/display.comp.glsl.
struct DisplayConstants {
    uint curve;    // ToneMap: 0 none, 1 Reinhard, 2 ACES, 3 AgX, 4 Khronos PBR Neutral
    uint srgb;     // encode
    float kept;    // of bloom: part of a pixel's light that stays
    float spread;  // and part of the first level of what spreads
    // ---- 16 B
    uint check;     // ExposureCheck: 0 off, 1 clipping, 2 false colour
    uint topFirst;  // 1: the top row is row 0; else the lowest one
    uint pad0;
    uint pad1;
    // ---- 32 B
    vec4 balance[3];  // columns of the matrix of white balance
    // ---- 80 B
    vec4 falseColors[FALSE_COLORS];
};  // 320 B

// Uniform block of image/view_mean.comp.glsl.
struct ViewMeanConstants {
    uint views;  // in the mean, this one included
    uint pad0;
    uint pad1;
    uint pad2;
};  // 16 B

// Uniform block of image/temporal_picture.comp.glsl.
struct TemporalPictureConstants {
    mat4 oldClipFromWorld;  // of the pixels' centres in the picture before
    // ---- 64 B
    vec4 oldDepth;      // of parallel rays: the row that makes the view depth of a point
    uint longest;       // views that are averaged at most
    uint fresh;         // 1: there is no picture before
    float oldParallel;  // of FrameConstants
    uint pad0;
};  // 96 B

// Uniform block of image/bloom_*.comp.glsl.
struct BloomConstants {
    float weight;    // of the level that is written, in what spreads
    float coarser;   // 1: the next coarser level is added; 0: there is none
    uint fromLevel;  // of the texture that is read
    uint pad0;
};  // 16 B

// Uniform block of image/headlight.comp.glsl.
struct HeadlightConstants {
    float irradiance;  // W/m^2, of surfaces that face the eye
    uint pad0;
    uint pad1;
    uint pad2;
};  // 16 B

// Uniform block of image/wireframe.*.
struct WireframeConstants {
    vec3 color;  // on the screen, before the tone map
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
static_assert(sizeof(conelight::gpu::Exposure) == 16);
static_assert(sizeof(conelight::gpu::DisplayConstants) == 320);
static_assert(sizeof(conelight::gpu::ViewMeanConstants) == 16);
static_assert(sizeof(conelight::gpu::TemporalPictureConstants) == 96);
static_assert(sizeof(conelight::gpu::BloomConstants) == 16);
static_assert(sizeof(conelight::gpu::HeadlightConstants) == 16);
static_assert(sizeof(conelight::gpu::WireframeConstants) == 32);
static_assert(sizeof(conelight::gpu::ShadowViewConstants) == 32);
#endif
