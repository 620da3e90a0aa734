#version 450 core
// SPDX-License-Identifier: MIT
// Sums of the voxelizer -> level 0 of the volume, one invocation per 2^3 voxels of the marked bricks; clears the sums
// behind it. Opacity is the covered area, at most 1; colour is premultiplied by it. BINARY_OPACITY: 1 where anything
// is. AXIS_AREAS: the areas along the three axes as well, of what faces their positive and their negative sides; and
// opacity is what is seen of them.
//
//   LEVEL_1  and the texel of level 1 that the eight make, as mip.comp.glsl would of what was stored
//   OCTREE   into each brick of the tree that holds the voxel; without LEVEL_1
//
// The volume is zero before; where there is nothing, nothing is stored.
#include "thesis/shaders/constants.h"
#include "thesis/shaders/defects.glsl"
#include "thesis/shaders/mip_texel.glsl"
#ifndef AXIS_AREAS
#define AXIS_AREAS 0
#endif
#ifndef OCTREE
#define OCTREE 0
#endif
#ifndef LEVEL_1
#define LEVEL_1 0
#endif
layout(local_size_x = 64) in;
layout(std140) uniform ThesisGridBlock { ThesisGrid grid; };
layout(std430) buffer SumTable { uint sums[]; };
layout(std430) readonly buffer BrickList { uint brickList[]; };
#if AXIS_AREAS
layout(std430) buffer AreaTable { uint areaSums[]; };
layout(rgba8) uniform writeonly image3D areasPlus;
layout(rgba8) uniform writeonly image3D areasMinus;
#if LEVEL_1
layout(rgba8) uniform writeonly image3D areasPlus1;
layout(rgba8) uniform writeonly image3D areasMinus1;
#endif
#endif
#if CLIPPED_RADIANCE
#define VOLUME_FORMAT rgba8
#else
#define VOLUME_FORMAT rgba16f
#endif
layout(VOLUME_FORMAT) uniform writeonly image3D volume;
#if LEVEL_1
layout(VOLUME_FORMAT) uniform writeonly image3D volume1;
#endif
#if OCTREE
#include "lib/radiance_octree.glsl"
#endif

// What a voxel holds.
struct Texel {
    vec4 light;
    vec4 plus, minus;  // areas
};

vec4 asUnorm8(vec4 v) { return unpackUnorm4x8(packUnorm4x8(v)); }
// As the texture keeps it.
vec4 asStored(vec4 light) {
#if CLIPPED_RADIANCE
    return asUnorm8(light);
#else
    return vec4(unpackHalf2x16(packHalf2x16(light.xy)), unpackHalf2x16(packHalf2x16(light.zw)));
#endif
}

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
    Texel texel = Texel(sum * scale, vec4(0.0), vec4(0.0));
#if AXIS_AREAS
    uvec3 both = uvec3(areaSums[3 * place], areaSums[3 * place + 1], areaSums[3 * place + 2]);
    areaSums[3 * place] = 0u;
    areaSums[3 * place + 1] = 0u;
    areaSums[3 * place + 2] = 0u;
    texel.plus.xyz = min(vec3(both & 0xffffu) / 512.0, 1.0);
    texel.minus.xyz = min(vec3(both >> 16) / 512.0, 1.0);
#if BINARY_OPACITY
    texel.plus.xyz = texel.minus.xyz = vec3(sum.a > 0.0 ? 1.0 : 0.0);
#else
    texel.light = sum * (seenOpacity(sum.a, texel.plus.xyz, texel.minus.xyz) / max(sum.a, 1e-12));
#endif
#endif
    return texel;
}

void storeAt(ivec3 at, Texel texel) {
    imageStore(volume, at, texel.light);
#if AXIS_AREAS
    imageStore(areasPlus, at, texel.plus);
    imageStore(areasMinus, at, texel.minus);
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

int placeInBrick(ivec3 inBrick) { return (inBrick.z * THESIS_BRICK + inBrick.y) * THESIS_BRICK + inBrick.x; }

// The eight voxels from `first` on, of which at least one holds something; their sums begin at `place`.
void resolveEight(ivec3 first, int place) {
    Texel sum = Texel(vec4(0.0), vec4(0.0), vec4(0.0));
    int i = 0;
    do {
        ivec3 side = ivec3(i & 1, i >> 1 & 1, i >> 2);
        int at = place + placeInBrick(side);
        if (sums[4 * at + 3] != 0u) {
            Texel texel = takeSums(at);
            store(first + side, texel);
            sum.light += asStored(texel.light);
            sum.plus += asUnorm8(texel.plus);
            sum.minus += asUnorm8(texel.minus);
        }
        ++i;
    } while (i < 8);
#if LEVEL_1 && AXIS_AREAS
    vec4 plus = mipAreas(sum.plus), minus = mipAreas(sum.minus);
    imageStore(volume1, first / 2, mipTexel(sum.light, plus, minus));
    imageStore(areasPlus1, first / 2, plus);
    imageStore(areasMinus1, first / 2, minus);
#elif LEVEL_1
    imageStore(volume1, first / 2, mipTexel(sum.light));
#endif
}

void main() {
    uint index = gl_WorkGroupID.y * 1024u + gl_WorkGroupID.x;
    if (index >= brickList[0]) return;
    uint bits = brickList[16u + index];
    ivec3 brick = ivec3(bits & 1023u, bits >> 10 & 1023u, bits >> 20);
    int eighth = int(gl_LocalInvocationIndex);
    ivec3 inBrick = 2 * ivec3(eighth & 3, eighth >> 2 & 3, eighth >> 4);
    int place = int(index) * THESIS_BRICK_VOXELS + placeInBrick(inBrick);
    uint weights = 0u;
    for (int i = 0; i < 8; ++i)
        weights |= sums[4 * (place + placeInBrick(ivec3(i & 1, i >> 1 & 1, i >> 2))) + 3];
    // A loop of one turn: unlike a branch, llvmpipe skips it where all of a vector have nothing.
    bool holds = weights != 0u;
    while (holds) {
        resolveEight(grid.boxMin.xyz + brick * THESIS_BRICK + inBrick, place);
        holds = false;
    }
}
