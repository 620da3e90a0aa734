// SPDX-License-Identifier: MIT
// Numbers that the passes of the thesis mode share: where its volume lies (uniform block
// ThesisGridBlock), and its cones (ThesisBlock). Filled by render/volume.cpp and render/cones.cpp.
#pragma once
#include "shared/prelude.h"
CONELIGHT_SHARED_BEGIN

// The cube of voxels, and the part of it that the scene touches.
struct ThesisGrid {
    vec3 origin;  // world position of the lowest corner
    float edge;   // m
    // ---- 16 B
    float voxelSize;  // m
    float size;       // voxels per axis of level 0
    float maxLevel;   // coarsest level in use
    float sumScale;   // fixed-point steps per unit of radiance in the voxelizer's sums
    // ---- 32 B: box of voxels that the voxelized surfaces can touch, and of its bricks
    ivec4 boxMin;   // xyz: voxel, a multiple of THESIS_BRICK; w: number of lights for voxel light
    ivec4 boxSize;  // xyz: voxels, multiples of THESIS_BRICK; w: number of instances
    // ---- 64 B
    ivec4
        along;  // x: axis along which triangles are voxelized, 3: the dominant one of each; y: 1 in one of three
                // passes, which share a surface
};              // 80 B

#define THESIS_BRICK 8  // voxels per axis of a brick: unit of sums, resolving and averaging
#define THESIS_BRICK_VOXELS 512

#define THESIS_PHONG 1u
#define THESIS_PHONG_AMBIENT 2u
#define THESIS_PHONG_DIFFUSE 4u
#define THESIS_PHONG_SPECULAR 8u
#define THESIS_SHADOWS 16u  // occlusion weakens direct light

struct ThesisConstants {
    // One march each: x spread, diameter = spread * t, 2 tan(aperture / 2) (specular: 0 means from the
    // material's shininess); y step as part of what is sampled; z distance of the first sample, m; w reach, m
    vec4 diffuseCone;
    vec4 specularCone;
    vec4 occlusionCone;
    // ---- 48 B
    float originOffset;      // diffuse cones start this far along the normal, m
    float shininessFalloff;  // exponent q of the angular weight
    float shadowStrength;    // gain inside the smoothstep of the occlusion cone
    float minSpecular;       // specular cones of less weight are not traced
    // ---- 64 B
    uint switches;    // THESIS_*
    uint maxSamples;  // per cone
    uint lightCount;
    float parallelSpread;  // of occlusion cones to lights without a place
};                         // 80 B

CONELIGHT_SHARED_END
#ifdef __cplusplus
static_assert(sizeof(conelight::gpu::ThesisGrid) == 80);
static_assert(sizeof(conelight::gpu::ThesisConstants) == 80);
#endif
