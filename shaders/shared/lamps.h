// SPDX-License-Identifier: MIT
// Lamps: the voxels about each (light/near_lamps.comp.glsl), and those that are drawn by chance: the tree over them
// (src/light/lamp_tree.h, lib/lamp_tree.glsl), and the pass that lights faces by it (light/lamp_faces.comp.glsl).
//
// Names: lampNodes (usamplerBuffer RGBA32UI: three texels a node), lampSlots (usamplerBuffer R32UI: a lamp's number in the
// light table).
#pragma once
#include "shared/prelude.h"
#define LAMP_RAYS 4  // of a draw
// Edge of the block of voxels about a lamp whose faces get its light as a mean over their triangles, voxels; odd. Farther
// away a face's middle stands for it. builtin:town at night errs alike with 3, 5 and 7.
#define NEAR_LAMP_BLOCK 5

CONELIGHT_SHARED_BEGIN

// Nodes stand in the order of a walk that goes into the first child first. The next one after all below a node is `next`;
// of a lamp that is the one behind it.
struct LampNode {
    vec3 center;  // of a sphere around its lamps, m
    float radius2;
    // ---- 16 B
    float power;  // W/sr, mean of the channels, sum over its lamps
    float reach;  // m: none of its lamps shines farther
    uint next;    // of the root: how many nodes there are
    uint firstSlot;
    // ---- 32 B
    uint slots;  // a lamp has about as many as its power asks for, at least one
    uint pad0;
    uint pad1;
    uint pad2;
};  // 48 B

// Uniform block of the pass over faces.
struct LampFaceConstants {
    uint firstFace;
    uint faceCount;
    uint round;     // number of the draw, part of every random number
    uint restarts;  // 1: what is known is of other lamps
};                  // 16 B

CONELIGHT_SHARED_END
#ifdef __cplusplus
static_assert(sizeof(conelight::gpu::LampNode) == 48);
static_assert(sizeof(conelight::gpu::LampFaceConstants) == 16);
#endif
