// SPDX-License-Identifier: MIT
// Baked light at voxel faces and at the vertices of its mesh: what C++ and GLSL share.
//
//   bakedFaces, bakedCorrections  two uints per face of the voxels of what does not move: irradiance / pi that was
//                baked, and the same less what cones gather there, as three halves; BAKED_FACE: there is any
//   faceCorrections  the latter, per face of the voxels of all
#pragma once
#include "shared/prelude.h"

#define BAKED_FACE 0x10000u  // in the upper half of the second uint

CONELIGHT_SHARED_BEGIN

struct BakedVertex {
    vec3 position;  // world
    uint instance;
    vec3 irradiance;  // / pi
    uint pad0;
};  // 32 B

CONELIGHT_SHARED_END
#ifdef __cplusplus
static_assert(sizeof(conelight::gpu::BakedVertex) == 32);
#endif
