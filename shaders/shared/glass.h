// SPDX-License-Identifier: MIT
// The tree over the triangles of glass, filled by src/scene/glass_tree.cpp and walked by lib/glass_tree.glsl.
#pragma once
#include "shared/prelude.h"
CONELIGHT_SHARED_BEGIN

// Nodes stand in the order in which a ray that meets every box would pass them: the next one is the first
// child, and `skip` leads past all that is below. Textures of buffers, RGBA32UI: glassNodes,
// glassTriangles.
struct GlassNode {
    vec3 lower;
    uint skip;
    // ---- 16 B
    vec3 upper;
    uint triangles;  // of a leaf: GLASS_LEAF * first + number; 0: an inner node
};                   // 32 B

#define GLASS_LEAF 16u
#define GLASS_END 0xffffffffu  // skip: nothing is left

#define GLASS_VEIL 0xfffffffeu  // GlassTriangle::solid: blended, no glass; hides a part of what lamps send

// In world space; corners counter-clockwise as seen from outside.
struct GlassTriangle {
    vec3 corner0;
    uint normal0;  // octahedral, 2 x 16 bit signed-normalised
    // ---- 16 B
    vec3 corner1;
    uint normal1;
    // ---- 32 B
    vec3 corner2;
    uint normal2;
    // ---- 48 B
    vec2 uv0;
    vec2 uv1;
    // ---- 64 B
    vec2 uv2;
    uint instance;
    uint solid;  // its number among solids of glass; CAUSTIC_NO_SOLID (shared/caustics.h), GLASS_VEIL: none
};               // 80 B

// Uniform block of the passes that draw glass.
struct GlassConstants {
    uint pass;    // of those that are averaged here
    uint passes;  // that are averaged
    float inverseVoxelSize;
    float fireflyClamp;
    // ---- 16 B
    uint firstPass;    // number of the first pass in a picture, part of every random number
    uint reflections;  // on metals, of one ray
    uint direct;       // 1: highlights of lights are wanted
    uint specular;     // 1: what rays bring is wanted
};                     // 32 B

CONELIGHT_SHARED_END
#ifdef __cplusplus
static_assert(sizeof(conelight::gpu::GlassNode) == 32);
static_assert(sizeof(conelight::gpu::GlassTriangle) == 80);
static_assert(sizeof(conelight::gpu::GlassConstants) == 32);
#endif
