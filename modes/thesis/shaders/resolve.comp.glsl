#version 450 core
// SPDX-License-Identifier: MIT
// Sums of the voxelizer -> level 0 of the volume, one group per marked brick; clears the sums behind it.
// Opacity is the covered area, at most 1; colour is premultiplied by it. BINARY_OPACITY: 1 where anything is.
// AXIS_AREAS: the areas along the three axes as well, of what faces their positive and their negative sides.
// OCTREE: into each brick of the tree that holds the voxel. The volume is zero before.
#include "thesis/shaders/constants.h"
#include "thesis/shaders/defects.glsl"
#ifndef AXIS_AREAS
#define AXIS_AREAS 0
#endif
#ifndef OCTREE
#define OCTREE 0
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
#if OCTREE
#include "lib/radiance_octree.glsl"
#endif

// What a voxel holds.
struct Texel {
    vec4 light;
    vec3 plus, minus;  // areas
};

Texel takeSums(int place) {
    int at = 4 * place;
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
    Texel texel = Texel(sum * scale, vec3(0.0), vec3(0.0));
#if AXIS_AREAS
    for (int k = 0; k < 3; ++k) {
        uint both = areaSums[3 * place + k];
        texel.plus[k] = float(both & 0xffffu) / 512.0;
        texel.minus[k] = float(both >> 16) / 512.0;
        areaSums[3 * place + k] = 0u;
    }
#if BINARY_OPACITY
    texel.plus = texel.minus = vec3(sum.a > 0.0 ? 1.0 : 0.0);
#endif
#endif
    return texel;
}

void storeAt(ivec3 at, Texel texel) {
    imageStore(volume, at, texel.light);
#if AXIS_AREAS
    imageStore(areasPlus, at, vec4(min(texel.plus, 1.0), 0.0));
    imageStore(areasMinus, at, vec4(min(texel.minus, 1.0), 0.0));
#endif
}

void store(ivec3 voxel, Texel texel) {
#if OCTREE
    int borders = octreeBorders(voxel);
    int axes = borders;
    do {
        ivec3 node = octreeHolder(voxel, axes);
        uvec2 record = octreeNode(node, 0);
        if (octreeHas(record, 0)) storeAt(octreeCornerOf(record, 0) + voxel - OCTREE_NODE_EDGE * node, texel);
        axes = octreeNextAxes(axes, borders);
    } while (axes >= 0);
#else
    storeAt(voxel, texel);
#endif
}

void main() {
    uint index = gl_WorkGroupID.y * 1024u + gl_WorkGroupID.x;
    if (index >= brickList[0]) return;
    uint bits = brickList[16u + index];
    ivec3 brick = ivec3(bits & 1023u, bits >> 10 & 1023u, bits >> 20);
    ivec3 voxel = grid.boxMin.xyz + brick * THESIS_BRICK + ivec3(gl_LocalInvocationID);
    int place = int(index) * THESIS_BRICK_VOXELS + int(gl_LocalInvocationIndex);
    // A loop of one turn: unlike a branch, llvmpipe skips it where all of a vector have nothing.
    bool holds = sums[4 * place + 3] != 0u;
    while (holds) {
        store(voxel, takeSums(place));
        holds = false;
    }
}
