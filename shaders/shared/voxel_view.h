// SPDX-License-Identifier: MIT
// What the views of voxels are told (src/image/voxel_view.cpp, image/voxel_view.comp.glsl).
#pragma once
#include "shared/prelude.h"

// VoxelViewConstants::data; conelight::VoxelData in the same order
#define VIEW_RADIANCE 0u
#define VIEW_IRRADIANCE 1u
#define VIEW_AGE 2u
#define VIEW_ALBEDO 3u
#define VIEW_NORMAL 4u
#define VIEW_EMISSION 5u
#define VIEW_COVERAGE 6u
#define VIEW_BRICKS 7u
#define VIEW_LEVEL 8u

CONELIGHT_SHARED_BEGIN

// Uniform block of these passes.
struct VoxelViewConstants {
    vec3 origin;      // lowest corner of level 0, m
    float voxelSize;  // m
    // ---- 16 B
    uint sizeX;  // voxels of level 0
    uint sizeY;
    uint sizeZ;
    uint data;  // VIEW_*
    // ---- 32 B
    float level;     // that is shown
    float spread;    // diameter per distance of the cone whose level is shown instead; 0: none
    float maxLevel;  // of what is read
    float density;   // of shape volume
    // ---- 48 B
    float pixelSize;  // edge of a pixel at a view depth of 1 m
    uint inside;      // 1: an eye outside the grid looks through the first wall
    uint pad1;
    uint pad2;
    // ---- 64 B: of SOURCE 1: box of voxels outside of which there is nothing
    ivec4 filledMin;   // xyz
    ivec4 filledSize;  // xyz
};                     // 96 B

CONELIGHT_SHARED_END
#ifdef __cplusplus
static_assert(sizeof(conelight::gpu::VoxelViewConstants) == 96);
#endif
