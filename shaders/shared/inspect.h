// SPDX-License-Identifier: MIT
// What the gathering of one pixel writes down step by step (lib/record_steps.glsl), and
// src/gather/step_recorder.cpp reads back. Units: m, W/(sr m^2).
//
// One storage buffer: RecordHeader, RECORD_PARTS x RecordedPart, RECORD_MAX_PATHS x RecordedPath,
// RECORD_MAX_STEPS x RecordedStep.
#pragma once
#include "shared/prelude.h"

// Rays of the dearest preset, 8 x 2 and 8 in 16 passes, are 384; cones are few but long.
#define RECORD_MAX_PATHS 2048
#define RECORD_MAX_STEPS 131072

// RecordedPath::kind; conelight::PathKind in the same order
#define PATH_DIFFUSE_CONE 0u
#define PATH_SPECULAR_CONE 1u
#define PATH_OCCLUSION_CONE 2u
#define PATH_COSINE_RAY 3u
#define PATH_LIGHT_RAY 4u
#define PATH_SPECULAR_RAY 5u
#define PATH_OCCLUSION_RAY 6u
#define PATH_CACHE_FACE 7u

// RecordedPath::end; conelight::PathEnd
#define END_OPEN 0u    // left the grid, or reached its length: what is left sees the sky
#define END_FULL 1u    // a cone that is opaque
#define END_FACE 2u    // a ray met a face
#define END_UNUSED 3u  // counts for nothing: below the surface, or did not reach its light face

// RecordedStep::kind; conelight::StepKind
#define STEP_SAMPLE 0u  // a cone read the volume
#define STEP_EMPTY 1u   // a ray crossed empty bricks
#define STEP_VOXEL 2u   // a ray crossed a voxel without a face towards it
#define STEP_TESTED 3u  // a ray was tested against a voxel's faces
#define STEP_HIT 4u     // the face it met

// Parts of the picture: RecordedPart
#define PART_DIFFUSE 0
#define PART_SPECULAR 1
#define PART_OCCLUSION 2
#define RECORD_PARTS 3

CONELIGHT_SHARED_BEGIN

struct RecordHeader {
    int pixelX;  // row 0 at the bottom
    int pixelY;
    uint paths;
    uint steps;
    // ---- 16 B
    uint pathSteps;  // steps of finished paths
    float share;     // of this pass in the mean over passes
    uint seen;       // 1: there is a surface at the pixel
    uint pad0;
    // ---- 32 B
    vec3 position;
    float depth;  // along the view axis
    // ---- 48 B
    vec3 normal;  // for shading
    float pad1;
};  // 64 B

// Sum of weight x radiance over the paths of the part, and what the surface makes of it.
struct RecordedPart {
    vec3 value;
    uint used;
    // ---- 16 B
    vec3 scale;
    float pad0;
};  // 32 B

struct RecordedPath {
    vec3 origin;
    uint kind;
    // ---- 16 B
    vec3 direction;
    float tanHalf;  // of a cone's half angle
    // ---- 32 B
    vec3 weight;
    float opacity;
    // ---- 48 B
    vec3 radiance;
    float distance;  // where it ended
    // ---- 64 B
    uint firstStep;
    uint stepCount;
    uint end;
    int face;  // -1: none
    // ---- 80 B: the face
    vec3 faceNormal;
    float facePlane;  // n.(c - voxel centre), voxels
    // ---- 96 B
    vec3 faceAlbedo;
    uint faceVoxel;  // as in FaceRecord
    // ---- 112 B
    vec3 faceRadiance;
    float faceCoverage;
    // ---- 128 B
    vec3 faceIrradiance;  // / pi
    uint faceUpdates;
};  // 144 B

struct RecordedStep {
    vec3 position;
    float size;  // edge of what was read or crossed
    // ---- 16 B
    vec3 radiance;  // that this step adds, opacity of what lies before it counted
    float opacity;  // that this step adds
    // ---- 32 B
    float distance;  // from the path's origin
    float level;     // 0: voxels
    float total;     // opacity so far
    uint kind;
};  // 48 B

CONELIGHT_SHARED_END
#ifdef __cplusplus
static_assert(sizeof(conelight::gpu::RecordHeader) == 64);
static_assert(sizeof(conelight::gpu::RecordedPart) == 32);
static_assert(sizeof(conelight::gpu::RecordedPath) == 144);
static_assert(sizeof(conelight::gpu::RecordedStep) == 48);
#endif
