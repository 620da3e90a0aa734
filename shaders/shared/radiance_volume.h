// SPDX-License-Identifier: MIT
// The radiance volume: what C++ and GLSL share. Written by src/gather/radiance_volume.cpp, read by cones
// (lib/cone_trace.glsl) and by the view of voxels.
//
// One RGBA16F 3D texture with levels, premultiplied radiance and opacity. Level l has texels of 2^l voxels.
// Six directions are six blocks side by side along x, block k for faces that look towards direction k of
// shared/voxels.h: one texture, so that the three blocks a cone needs are chosen by coordinate.
//
// Every axis is a multiple of 2^maxLevel, so that all levels have whole texels.
#pragma once
#include "shared/prelude.h"

CONELIGHT_SHARED_BEGIN

struct RadianceVolume {
    vec3 origin;  // world position of the lowest corner of each block, m
    float voxelSize;
    // ---- 16 B
    vec3 inverseExtent;  // 1 / extent of a block, 1/m
    float inverseVoxelSize;
    // ---- 32 B
    vec3 extent;  // of a block, m
    float maxLevel;
    // ---- 48 B
    uint sizeX;  // texels of level 0 per block
    uint sizeY;
    uint sizeZ;
    float halfTexelX;  // 0.5 / sizeX
};                     // 64 B

CONELIGHT_SHARED_END
#ifdef __cplusplus
static_assert(sizeof(conelight::gpu::RadianceVolume) == 64);
#endif
