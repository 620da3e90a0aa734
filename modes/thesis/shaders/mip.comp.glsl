#version 450 core
// SPDX-License-Identifier: MIT
// Level l of the thesis's volume -> level l+1, within marked bricks (BRICK_TEXELS texels of level l+1 per
// brick: 64, 8 or 1) or, when BRICK_TEXELS is 0, over the whole box. Where level 0 is made of sums in a dense texture,
// level 1 is made with it (resolve.comp.glsl). AREAS: the volume of areas along the axes;
// SEEN: the areas of level l+1 are there, and opacity is what is seen of them. OCTREE: all texels of the tree's bricks of level l+1.
#include "thesis/shaders/constants.h"
#include "thesis/shaders/defects.glsl"
#include "thesis/shaders/mip_texel.glsl"
#ifndef OCTREE
#define OCTREE 0
#endif
#if !defined(BRICK_TEXELS) && !OCTREE
#error BRICK_TEXELS must be 64, 8, 1 or 0
#endif
#ifndef AREAS
#define AREAS 0
#endif
#ifndef SEEN
#define SEEN 0
#endif
#if CLIPPED_RADIANCE || AREAS
#define VOLUME_FORMAT rgba8
#else
#define VOLUME_FORMAT rgba16f
#endif
#if OCTREE
layout(local_size_x = 64) in;
#include "lib/linear_index.glsl"
#include "lib/octree_levels.glsl"
#elif BRICK_TEXELS
layout(local_size_x = 64) in;
layout(std430) readonly buffer BrickList { uint brickList[]; };
#else
layout(local_size_x = 8, local_size_y = 4, local_size_z = 4) in;
#endif
layout(std140) uniform ThesisGridBlock { ThesisGrid grid; };
layout(VOLUME_FORMAT) uniform readonly image3D fine;
layout(VOLUME_FORMAT) uniform writeonly image3D coarse;
#if SEEN
layout(rgba8) uniform readonly image3D areasPlus;
layout(rgba8) uniform readonly image3D areasMinus;
#endif

// Where a texel lies, and the first of the eight that it is made of.
struct MipPlace {
    ivec3 coarse;
    ivec3 fine;
    bool empty;  // there are no eight
};

// Whether the invocation makes one.
#if OCTREE
bool findTexel(out MipPlace p) {
    OctreeLevelPlace t;
    bool found = octreeTexelToFill(linearIndex(), t);
    p = MipPlace(t.coarse, t.fine, t.empty);
    return found;
}
#elif BRICK_TEXELS
bool findTexel(out MipPlace p) {
    const int kEdge = BRICK_TEXELS == 64 ? 4 : BRICK_TEXELS == 8 ? 2 : 1;
    uint linear = (gl_WorkGroupID.y * 1024u + gl_WorkGroupID.x) * 64u + gl_LocalInvocationID.x;
    uint index = linear / BRICK_TEXELS;
    if (index >= brickList[0]) return false;
    uint bits = brickList[16u + index];
    ivec3 brick = ivec3(bits & 1023u, bits >> 10 & 1023u, bits >> 20);
    int inBrick = int(linear) % BRICK_TEXELS;
    p.coarse = (grid.boxMin.xyz / THESIS_BRICK + brick) * kEdge +
               ivec3(inBrick % kEdge, inBrick / kEdge % kEdge, inBrick / (kEdge * kEdge));
    p.fine = 2 * p.coarse;
    p.empty = false;
    return true;
}
#else
bool findTexel(out MipPlace p) {
    // The image is as large as the box of this level, rounded outward, needs.
    ivec3 ratio = ivec3(int(grid.size)) / imageSize(coarse);
    p.coarse = grid.boxMin.xyz / ratio + ivec3(gl_GlobalInvocationID);
    p.fine = 2 * p.coarse;
    p.empty = false;
    return all(lessThan(p.coarse, (grid.boxMin.xyz + grid.boxSize.xyz + ratio - 1) / ratio));
}
#endif

void main() {
    MipPlace p;
    if (!findTexel(p)) return;
    vec4 sum = vec4(0.0);
    for (int i = 0; i < (p.empty ? 0 : 8); ++i)
        sum += imageLoad(fine, p.fine + ivec3(i & 1, i >> 1 & 1, i >> 2));
#if AREAS
    imageStore(coarse, p.coarse, mipAreas(sum));
#elif SEEN
    imageStore(coarse, p.coarse,
               mipTexel(sum, imageLoad(areasPlus, p.coarse), imageLoad(areasMinus, p.coarse)));
#else
    imageStore(coarse, p.coarse, mipTexel(sum));
#endif
}
