#version 450 core
// SPDX-License-Identifier: MIT
// A level of the radiance volume from the next finer one: each texel from eight. docs/theory/2_voxels.md,
// "Levels".
//   DIRECTIONAL  four columns of two texels along the block's direction, front one first, then their mean
//   AREA         a column's opacities add up (connected surface) instead of hiding each other (fog).
//   Isotropic:
//                areas add up, and a texel of twice the size shows four times the area
//   SPARSE       one invocation per texel of an occupied brick (levels 1 and 2), else one per texel
//   OCTREE       one invocation per texel of the octree's bricks of this level; fine and coarse are both its
//                texture of bricks
#if !defined(DIRECTIONAL) || !defined(AREA) || !defined(SPARSE) || !defined(OCTREE)
#error DIRECTIONAL, AREA, SPARSE and OCTREE must be 0 or 1
#endif
#include "lib/radiance_volume.glsl"
#if OCTREE || SPARSE
layout(local_size_x = 64) in;  // before linear_index, which asks for it
#include "lib/linear_index.glsl"
#else
layout(local_size_x = 8, local_size_y = 4, local_size_z = 4) in;
#endif
#if OCTREE
#include "lib/octree_levels.glsl"
#elif SPARSE
#include "lib/voxel_address.glsl"
#include "lib/voxel_grid.glsl"
layout(std430) readonly buffer BrickTable { uint brickList[]; };
#endif
layout(rgba16f) readonly uniform image3D fine;
layout(rgba16f) writeonly uniform image3D coarse;
const int kBlocks = DIRECTIONAL == 1 ? 6 : 1;

// Opacity and colour of `front` with `back` behind it, both premultiplied.
vec4 compositeColumn(vec4 front, vec4 back) {
#if AREA
    float visible = min(back.a, 1.0 - front.a) / max(back.a, 1e-6);
    return front + back * visible;
#else
    return front + (1.0 - front.a) * back;
#endif
}

// The texel of `coarse` that an invocation makes, and the first of the eight of `fine` that it is made of.
struct LevelPlace {
    ivec3 coarse;
    ivec3 fine;
    int block;
    bool empty;  // there are no eight in `fine`
};

// Whether the invocation makes one.
#if OCTREE
bool findTexels(out LevelPlace t) {
    OctreeLevelPlace texel;
    bool found = octreeTexelToFill(linearIndex(), texel);
    t = LevelPlace(texel.coarse, texel.fine, texel.block, texel.empty);
    return found;
}
#elif SPARSE
bool findTexels(out LevelPlace t) {
    int blockWidth = imageSize(coarse).x / kBlocks;
    // Level 1 has 2^3 texels per brick, level 2 one.
    int edge = blockWidth * 2 == int(volume.sizeX) ? 2 : 1;
    int perBrick = edge * edge * edge;
    int index = int(linearIndex());
    int inBrick = index % perBrick;
    int brickBlock = index / perBrick;
    t.block = brickBlock % kBlocks;
    uint number = uint(brickBlock / kBlocks);
    if (number >= grid.occupiedBricks) return false;
    ivec3 local = ivec3(inBrick % edge, (inBrick / edge) % edge, inBrick / (edge * edge));
    t.coarse = unpackVoxel(brickList[number]) * edge + local;
    t.coarse.x += t.block * blockWidth;
    t.fine = 2 * t.coarse;
    t.empty = false;
    return true;
}
#else
bool findTexels(out LevelPlace t) {
    t.coarse = ivec3(gl_GlobalInvocationID);
    t.fine = 2 * t.coarse;
    t.block = t.coarse.x / (imageSize(coarse).x / kBlocks);
    t.empty = false;
    return all(lessThan(t.coarse, imageSize(coarse)));
}
#endif

void main() {
    LevelPlace t;
    if (!findTexels(t)) return;

    // Four columns of two texels along axis `along`; the loads are addressed, not the loaded values indexed,
    // which a software driver would do through memory.
    int axis = t.block >> 1;
    ivec3 along = ivec3(axis == 0, axis == 1, axis == 2);
    ivec3 across = ivec3(axis != 0, axis == 0, 0);
    ivec3 over = ivec3(1) - along - across;
    // A face looking towards +x is seen from +x: the texel with the larger coordinate is in front.
    ivec3 front = t.fine + ((t.block & 1) == 0 ? along : ivec3(0));
    ivec3 back = t.fine + ((t.block & 1) == 0 ? ivec3(0) : along);
    vec4 sum = vec4(0.0);
    for (int i = 0; i < (t.empty ? 0 : 4); ++i) {
        ivec3 column = (i & 1) * across + (i >> 1) * over;
        vec4 nearer = imageLoad(fine, front + column);
        vec4 farther = imageLoad(fine, back + column);
#if DIRECTIONAL
        sum += compositeColumn(nearer, farther);
#else
        sum += nearer + farther;
#endif
    }
#if DIRECTIONAL || AREA
    sum *= 0.25;
#else
    sum *= 0.125;
#endif
#if !DIRECTIONAL && AREA
    sum /= max(sum.a, 1.0);
#endif
    imageStore(coarse, t.coarse, sum);
}
