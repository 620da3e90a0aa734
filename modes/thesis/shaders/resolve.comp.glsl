#version 450 core
// SPDX-License-Identifier: MIT
// Sums of the voxelizer -> level 0 of the volume, one group per marked brick; clears the sums behind it.
// Opacity is the covered area, at most 1; colour is premultiplied by it. BINARY_OPACITY: 1 where anything is.
// AXIS_AREAS: the areas along the three axes as well, of what faces their positive and their negative sides.
#include "thesis/shaders/constants.h"
#include "thesis/shaders/defects.glsl"
#ifndef AXIS_AREAS
#define AXIS_AREAS 0
#endif
layout(local_size_x = 8, local_size_y = 8, local_size_z = 8) in;
layout(std140) uniform ThesisGridBlock { ThesisGrid grid; };
layout(std430) buffer SumTable { uint sums[]; };
layout(std430) readonly buffer BrickList { uint brickList[]; };
#if AXIS_AREAS
layout(std430) buffer AreaTable { uint areaSums[]; };
layout(rgba8) uniform writeonly image3D areasPlus;
layout(rgba8) uniform writeonly image3D areasMinus;
#endif
#if CLIPPED_RADIANCE
layout(rgba8) uniform writeonly image3D volume;
#else
layout(rgba16f) uniform writeonly image3D volume;
#endif

void main() {
    uint index = gl_WorkGroupID.y * 1024u + gl_WorkGroupID.x;
    if (index >= brickList[0]) return;
    uint bits = brickList[16u + index];
    ivec3 brick = ivec3(bits & 1023u, bits >> 10 & 1023u, bits >> 20);
    ivec3 inBox = brick * THESIS_BRICK + ivec3(gl_LocalInvocationID);
    int inOrder = (inBox.z * grid.boxSize.y + inBox.y) * grid.boxSize.x + inBox.x;
    int at = 4 * inOrder;
    vec4 sum =
        vec4(vec3(sums[at], sums[at + 1], sums[at + 2]) / grid.sumScale, float(sums[at + 3]) / 16777216.0);
    sums[at] = 0u;
    sums[at + 1] = 0u;
    sums[at + 2] = 0u;
    sums[at + 3] = 0u;
#if BINARY_OPACITY
    float scale = sum.a > 0.0 ? 1.0 / sum.a : 0.0;
#else
    float scale = 1.0 / max(sum.a, 1.0);
#endif
    imageStore(volume, grid.boxMin.xyz + inBox, sum * scale);
#if AXIS_AREAS
    vec3 plus = vec3(0.0), minus = vec3(0.0);
    for (int k = 0; k < 3; ++k) {
        uint both = areaSums[3 * inOrder + k];
        plus[k] = float(both & 0xffffu) / 512.0;
        minus[k] = float(both >> 16) / 512.0;
        areaSums[3 * inOrder + k] = 0u;
    }
#if BINARY_OPACITY
    plus = minus = vec3(sum.a > 0.0 ? 1.0 : 0.0);
#endif
    imageStore(areasPlus, grid.boxMin.xyz + inBox, vec4(min(plus, 1.0), 0.0));
    imageStore(areasMinus, grid.boxMin.xyz + inBox, vec4(min(minus, 1.0), 0.0));
#endif
}
