// SPDX-License-Identifier: MIT
// What the passes that gather by rays at pixels share with src/gather/pixel_rays.cpp.
#pragma once
#include "shared/irradiance.h"
#include "shared/prelude.h"

// Names, besides those of voxels, surfaces and lights:
//   pixelHistory       usampler2D: the picture so far (lib/pixel_history.glsl)
//   irradiancePicture  usampler2D: gathered irradiance, for composition
//   lobePicture        usampler2D: radiance in the specular lobe, for composition
//   Motion             storage: mat4 per instance, world of the frame before from world of this one
//   hostMotion         sampler2D: where a host's pixels were, less where they are (HostSurfaces::motion); with motionStep 0
//                      where surfaces were in the world, less where they are, m (view/motion_picture.h)
//   LobeList           storage: group counts of an indirect dispatch, number of pixels, first row of groups, pixels
#define LOBE_GROUPS_X 32u  // in x of that dispatch; y may be 65,535

// How a pass takes up the picture so far.
#define REUSE_NONE 0u         // not at all
#define REUSE_SAME_VIEW 1u    // it has the same view
#define REUSE_REPROJECTED 2u  // it has another view, or things have moved

CONELIGHT_SHARED_BEGIN

// Uniform block of these passes.
struct PixelRayConstants {
    mat4 oldClipFromWorld;  // of the picture so far
    // ---- 64 B
    vec3 oldEye;
    float planeTolerance;  // m: the picture so far counts where its surface is no farther off the plane
    // ---- 80 B
    vec3 oldForward;  // as in FrameConstants
    uint pass;        // number of the pass, part of every random number
    // ---- 96 B
    vec3 oldRight;
    uint rays;  // of each kind, per pixel
    // ---- 112 B
    vec3 oldUp;
    float longestMean;  // passes that are averaged at most, far from `places`
    // ---- 128 B
    float specularLimit;  // rougher surfaces get no rays into the lobe
    float reach;          // of occlusion, voxels
    float inverseVoxelSize;
    uint reflections;  // on metals, of one ray
    // ---- 144 B
    float fireflyClamp;  // firefly clamp: of radiance by glossy bounces, over that of the diffuse metal
    uint lowestX;        // lowest pixel of the dispatch
    uint lowestY;
    float oldParallel;  // of FrameConstants
    // ---- 160 B: of MOTION 2
    float motionScaleX;  // texel -> part of the picture's width
    float motionScaleY;
    uint motionStep;  // one of so many texels in each direction is a pixel; 0: each is one, of the world
    uint reuse;       // REUSE_*
    // ---- 176 B
    float shortestMean;      // passes that are averaged at most, at `places`
    float shortestLobeMean;  // of what smooth surfaces show of `places`
    uint placeCount;
    uint lightEdits;
    // ---- 192 B
    vec4 places[CHANGED_PLACES];     // of what changed last, as in CacheConstants
    vec4 placeParts[CHANGED_FOURS];  // as there
    // ---- 512 B
    float editedEverywhere;
    float editedEverywherePart;
    float shortestLightMean;  // where light is another
    uint allLightEdits;
    // ---- 528 B
    vec3 lightScale;  // 1: of the light of the picture so far
    float scaledEverywhere;
    // ---- 544 B
    float scaledEverywherePart;
    uint pad0;
    uint pad1;
    uint pad2;
    // ---- 560 B
    vec4 dimmed;
    // ---- 576 B
    vec4 editedLights[CHANGED_LIGHTS];
    vec4 editedAxes[CHANGED_LIGHTS];
    vec4 editedLimits[CHANGED_LIGHTS];
};  // 2112 B

CONELIGHT_SHARED_END
#ifdef __cplusplus
static_assert(sizeof(conelight::gpu::PixelRayConstants) == 2112);
#endif
