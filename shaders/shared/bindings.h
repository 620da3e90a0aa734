// SPDX-License-Identifier: MIT
// Binding numbers, one table for C++ and GLSL. Tables that every pass may read have fixed numbers; 8 and up
// (storage), 8 and up (textures), 0 to 5 (images) and 2 to 6 (uniform) belong to the running pass.
#pragma once
#include "shared/prelude.h"

// Uniform buffers
#define BINDING_FRAME 0         // FrameConstants
#define BINDING_VOXEL_GRID 1    // VoxelGrid
#define BINDING_PASS 2          // a pass's own constants
#define BINDING_FIXED_LIGHTS 7  // the light table once more, for shaders that know how many there are

// Storage buffers of the scene (GpuScene::bind)
#define BINDING_VERTICES 0
#define BINDING_INDICES 1
#define BINDING_INSTANCES 2
#define BINDING_MATERIALS 3
#define BINDING_LIGHTS 4
#define BINDING_STORAGE_PASS \
    8  // first number free for passes; up to 15 (GL minimum is 8 per stage, 4.5 drivers have 16)

// Texture units
#define UNIT_MATERIAL_BASE 0  // G-buffer raster: textures of the drawn material
#define UNIT_MATERIAL_METAL_ROUGH 1
#define UNIT_MATERIAL_NORMAL 2
#define UNIT_MATERIAL_EMISSIVE 3
#define UNIT_MATERIAL_SPECULAR 4
#define UNIT_MATERIAL_SPECULAR_COLOR 5
#define UNIT_SURFACE_ARRAY 6  // all textures at low resolution, for compute (GpuScene)
#define UNIT_PASS 8           // first unit free for passes
// Units of the G-buffer (GBuffer::bind), fixed because many passes read it: UNIT_GBUFFER and the next
#define UNIT_GBUFFER 22
// Units of the light stage, fixed because several stages shade
#define UNIT_SHADOW 24           // sampler2DArrayShadow, all shadow maps (lib/shadow.glsl)
#define UNIT_SHADOW_DEPTHS 26    // sampler2DArray, the same
#define UNIT_SHADOW_SURFACES 27  // usampler2DArray RG32UI, of lights other than rectangles
