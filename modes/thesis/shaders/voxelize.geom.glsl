#version 450 core
// SPDX-License-Identifier: MIT
// Triangle -> the same triangle seen along its dominant axis (thesis, "Dominant Axis Selection"): the largest
// component of its normal becomes the direction of view, so that the viewport of N x N pixels shows it with
// as many pixels as it has voxels. AXIS_AREAS: with what the fragment shader needs for areas along the other axes.
#include "lib/dot.glsl"
#include "thesis/shaders/constants.h"
#include "thesis/shaders/dominant_axis.glsl"
#ifndef AXIS_AREAS
#define AXIS_AREAS 0
#endif
layout(triangles) in;
layout(triangle_strip, max_vertices = 3) out;
layout(std140) uniform ThesisGridBlock { ThesisGrid grid; };

layout(location = 0) in vec3 position[];
layout(location = 1) in vec3 normal[];
layout(location = 2) in vec2 uv[];
layout(location = 3) flat in uint color[];
layout(location = 4) flat in uint material[];

layout(location = 0) flat out uvec4 outConstant;  // axis, material, vertex colour, share (bits)
layout(location = 1) out vec3 outGridPosition;    // in voxels, not permuted
layout(location = 2) out vec3 outNormal;
layout(location = 3) out vec2 outUv;
#if AXIS_AREAS
// Area seen along each axis, in parts of that along the dominant one; the signs are those of the normal.
layout(location = 4) flat out vec3 outAreas;
#endif

void main() {
    vec3 world[3] = vec3[3](position[0], position[1], position[2]);
    vec3 across = cross(world[1] - world[0], world[2] - world[0]);
    vec3 weight = abs(across);
    uint axis = voxelizationAxis(weight, grid.along);
    float front = dot(across, normal[0] + normal[1] + normal[2]) < 0.0 ? -1.0 : 1.0;
    vec3 areas = areasSeen(front * across, axis);
    uint share = floatBitsToUint(passShare(weight, axis, grid.along));
    for (int i = 0; i < 3; ++i) {
        outConstant = uvec4(axis, material[0], color[0], share);
#if AXIS_AREAS
        outAreas = areas;
#endif
        outGridPosition = (world[i] - grid.origin) / grid.voxelSize;
        outNormal = normal[i];
        outUv = uv[i];
        vec3 p = permuted((world[i] - grid.origin) / grid.voxelSize, axis);
        gl_Position = vec4(p * (2.0 / grid.size) - 1.0, 1.0);
        EmitVertex();
    }
    EndPrimitive();
}
