#version 450 core
// SPDX-License-Identifier: MIT
// Fragment of a triangle seen along its dominant axis -> its direct light, put into the volume (voxel_sums.glsl).
// For the defect center_coverage alone: the rasterizer makes fragments at covered pixel centres, as in the original.
// DARK_EMITTERS: without emission, as for emitters that are lights as well (LIGHT_FROM_EMITTER), which would light
// everything twice.
#include "lib/dot.glsl"
#include "thesis/shaders/constants.h"
layout(std140) uniform ThesisGridBlock { ThesisGrid grid; };
#include "thesis/shaders/voxel_sums.glsl"

layout(location = 0) flat in uvec4 constant;
layout(location = 1) in vec3 gridPosition;
layout(location = 2) in vec3 normal;
layout(location = 3) in vec2 uv;
#if AXIS_AREAS
layout(location = 4) flat in vec3 areas;
#else
const vec3 areas = vec3(0.0);
#endif

void main() {
    SurfaceOfPiece surface = surfaceOfPiece(constant.x, constant.y, constant.z, areas, false);
    addPiece(Piece(gridPosition, normalize(normal), uv, uintBitsToFloat(constant.w)), surface,
             floor(gl_FragCoord.xy));
}
