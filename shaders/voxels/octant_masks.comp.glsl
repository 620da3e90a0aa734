#version 450 core
// SPDX-License-Identifier: MIT
// Occupied bricks -> octWord's masks: one invocation per brick gathers which voxels have faces in which
// direction, and combines three directions for each octant. Bricks without a voxel that faces an octant keep
// what the texture was cleared to: empty. Rows of bits say which bricks those are not.
layout(local_size_x = 64) in;
#include "lib/linear_index.glsl"
#include "lib/voxel_address.glsl"
#include "lib/voxel_grid.glsl"
#include "voxels/octant_rows.glsl"
uniform usampler3D voxelBricks;
uniform usamplerBuffer voxelRecords;
layout(std430) readonly buffer BrickTable { uint brickList[]; };
layout(std430) buffer RowTable { uint rows[]; };
layout(rg32ui) uniform writeonly uimage3D octants;

// The brick's voxels in the opposite order along the axes that rays of the octant go down.
uvec2 mirrored(uvec2 m, int octant) {
    uvec2 x = ((m & 0x11111111u) << 3) | ((m & 0x22222222u) << 1) | ((m >> 1) & 0x22222222u) |
              ((m >> 3) & 0x11111111u);
    m = (octant & 1) != 0 ? x : m;
    uvec2 y = ((m & 0x000f000fu) << 12) | ((m & 0x00f000f0u) << 4) | ((m >> 4) & 0x00f000f0u) |
              ((m >> 12) & 0x000f000fu);
    m = (octant & 2) != 0 ? y : m;
    uvec2 z = (m.yx << 16) | (m.yx >> 16);
    return (octant & 4) != 0 ? z : m;
}

void main() {
    uint index = linearIndex();
    bool used = index < grid.occupiedBricks;
    ivec3 brick = unpackVoxel(brickList[used ? index : 0u]);
    uvec4 word = texelFetch(voxelBricks, brick, 0);
    uvec2 mask[6] = uvec2[6](uvec2(0u), uvec2(0u), uvec2(0u), uvec2(0u), uvec2(0u), uvec2(0u));
    uvec2 left = word.xy;
    int record = int(word.z);
    do {
        // The lowest voxel that is left; none: adds nothing.
        bool low = left.x != 0u;
        uint lowest = low ? left.x & (0u - left.x) : left.y & (0u - left.y);
        uvec2 bit = low ? uvec2(lowest, 0u) : uvec2(0u, lowest);
        uint directions = texelFetch(voxelRecords, record).x >> 26;
        for (int k = 0; k < 6; ++k) mask[k] |= (directions >> k & 1u) != 0u ? bit : uvec2(0u);
        left ^= bit;
        ++record;
    } while ((left.x | left.y) != 0u);
    if (!used) return;
    for (int octant = 0; octant < 8; ++octant) {
        // Rays that go down along an axis meet the faces that look up.
        uvec2 facing = ((octant & 1) != 0 ? mask[0] : mask[1]) | ((octant & 2) != 0 ? mask[2] : mask[3]) |
                       ((octant & 4) != 0 ? mask[4] : mask[5]);
        bool some = (facing.x | facing.y) != 0u;
        facing = mirrored(facing, octant);
        if (facing.y == OCTANT_EMPTY) facing.y |= OCTANT_EMPTY_SPARE;
        bvec3 down = notEqual(ivec3(octant) & ivec3(1, 2, 4), ivec3(0));
#if NESTED_GRIDS
        // Mirrored within its level.
        int base = brick.z / int(grid.bricksZ) * int(grid.bricksZ);
        ivec3 within = brick - ivec3(0, 0, base);
        ivec3 at = mix(within, gridBricks() - 1 - within, down) + ivec3(0, 0, base);
#else
        ivec3 at = mix(brick, gridBricks() - 1 - brick, down);
#endif
        if (some) {
            imageStore(octants, ivec3(at.x + octant * int(grid.bricksX), at.yz), uvec4(facing, 0u, 0u));
            atomicOr(rows[octantRow(octant, ivec3(at.x >> 5, at.yz), storedBricks())], 1u << (at.x & 31));
        }
    }
}
