#version 450 core
// SPDX-License-Identifier: MIT
// Occupancy for views of voxels, one texel per brick of 4^3 voxels: x, y which of them hold something (bits
// of lib/voxel_address.glsl), z how many bricks to each side are empty as well, a power of two or 0
// (voxel_view_reach), w 0. One invocation per brick.
//
//   SOURCE  0 from the surface voxels' words: right for all that is made of them
//           1 from a volume of one colour and opacity a voxel (VoxelVolume of src/image/voxel_view.h): of
//             bricks whose mean two levels up is not zero, every voxel. Outside of its box there is nothing
//           4 from such a volume in an octree: a brick is one of its nodes
#ifndef SOURCE
#error SOURCE must be 0, 1 or 4
#endif
layout(local_size_x = 8, local_size_y = 4, local_size_z = 4) in;
#include "shared/voxel_view.h"
layout(rgba32ui) writeonly uniform uimage3D occupied;
#include "shared/voxel_view.h"
#if SOURCE == 0
#include "lib/voxel_grid.glsl"
layout(rgba32ui) readonly uniform uimage3D voxelBrickImage;
#else
layout(std140) uniform ViewBlock { VoxelViewConstants view; };
uniform sampler3D volume;
#endif
#if SOURCE == 4
#include "lib/radiance_octree.glsl"
#endif

void main() {
    ivec3 brick = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(brick, imageSize(occupied)))) return;
    uvec2 mask = uvec2(0u);
#if SOURCE == 0
    // Volumes may be larger than the grid.
    if (all(lessThan(brick, gridBricks()))) mask = imageLoad(voxelBrickImage, brick).xy;
#elif SOURCE == 4
    uvec2 record = octreeNode(brick, 0);
    bool empty = !octreeHas(record, 0);
    ivec3 corner = empty ? ivec3(0) : octreeCornerOf(record, 0);
    for (int i = 0; i < (empty ? 0 : 64); ++i) {
        ivec3 inBrick = ivec3(i & 3, (i >> 2) & 3, i >> 4);
        uint bit = texelFetch(volume, corner + inBrick, 0).a > 0.0 ? 1u << (i & 31) : 0u;
        mask |= i < 32 ? uvec2(bit, 0u) : uvec2(0u, bit);
    }
#else
    // Eight bits a channel may round a mean down to nothing; halves do not.
    bool empty = any(greaterThanEqual(4 * brick, view.filledMin.xyz + view.filledSize.xyz)) ||
                 any(lessThanEqual(4 * brick + 4, view.filledMin.xyz));
#if HALVES
    empty = empty || texelFetch(volume, brick, 2) == vec4(0.0);
#endif
    for (int i = 0; i < (empty ? 0 : 64); ++i) {
        ivec3 voxel = 4 * brick + ivec3(i & 3, (i >> 2) & 3, i >> 4);
        uint bit = texelFetch(volume, voxel, 0).a > 0.0 ? 1u << (i & 31) : 0u;
        mask |= i < 32 ? uvec2(bit, 0u) : uvec2(0u, bit);
    }
#endif
    imageStore(occupied, brick, uvec4(mask, 0u, 0u));
}
