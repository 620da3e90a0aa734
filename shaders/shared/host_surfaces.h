// SPDX-License-Identifier: MIT
// What view/host_surfaces.frag.glsl has to know of a host's picture. Uniform block HostSurfaceBlock.
#pragma once
#include "shared/prelude.h"

// Encodings of normals, in the order of NormalEncoding.
#define HOST_NORMAL_WORLD 0
#define HOST_NORMAL_WORLD_UNORM 1
#define HOST_NORMAL_VIEW 2
#define HOST_NORMAL_VIEW_UNORM 3
#define HOST_NORMAL_OCTAHEDRAL 4

CONELIGHT_SHARED_BEGIN

struct HostSurfaceConstants {
    mat4 worldFromView;  // of normals: its upper 3 x 3
    // ---- 64 B: view depth w of a texel d: w = depthOfEye / (depthScale d + depthOffset - dot(depthRow, ray)),
    // where position = eye + w ray; of parallel rays w = depthScale d + depthOffset
    vec3 depthRow;
    float depthOfEye;
    float depthScale;
    float depthOffset;
    float background;  // texel where nothing was drawn
    uint encoding;     // HOST_NORMAL_*
    // ---- 96 B
    uint reduction;  // one of reduction x reduction texels is taken
    uint instances;  // number of instances in the scene
    uint roughnessChannel;
    uint pad0;
};  // 112 B

CONELIGHT_SHARED_END
#ifdef __cplusplus
static_assert(sizeof(conelight::gpu::HostSurfaceConstants) == 112);
#endif
