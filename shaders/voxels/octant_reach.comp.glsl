#version 450 core
// SPDX-License-Identifier: MIT
// octWord: the reach of empty space, where it is less than the OCTANT_REACH that the texture was cleared to.
// A cube of bricks is empty when none of its rows has a brick with a face towards the octant; rows are words
// with a bit per brick (octant_masks), so one invocation does 32 bricks at once. What lies outside the grid
// is empty.
layout(local_size_x = 64) in;
#include "lib/linear_index.glsl"
#include "lib/voxel_grid.glsl"
#include "voxels/octant_rows.glsl"
#if OCTANT_REACH != 4
#error reaches of 1 to 4 are told apart
#endif
uniform usamplerBuffer rows;
layout(rg32ui) uniform writeonly uimage3D octants;

void main() {
    ivec3 bricks = storedBricks();
    int words = octantRowWords(bricks);
    int index = int(linearIndex());
    bool used = index < 8 * bricks.z * bricks.y * words;
    index = used ? index : 0;
    int word = index % words;
    int y = index / words % bricks.y;
    int z = index / (words * bricks.y) % bricks.z;
    int octant = index / (words * bricks.y * bricks.z);

#if NESTED_GRIDS
    int endZ = (z / int(grid.bricksZ) + 1) * int(grid.bricksZ);  // of the level
#else
    int endZ = bricks.z;
#endif

    // Rows of the cubes with edges of 1 to 4 bricks, this word and the next.
    uint taken1 = 0u;
    uvec2 two = uvec2(0u), three = uvec2(0u), four = uvec2(0u);
    for (int i = 0; i < 16; ++i) {
        int dy = i & 3, dz = i >> 2;
        bool inside = y + dy < bricks.y && z + dz < endZ;
        int at = inside ? octantRow(octant, ivec3(word, y + dy, z + dz), bricks) : 0;
        uvec2 row = uvec2(texelFetch(rows, at).x, word + 1 < words ? texelFetch(rows, at + 1).x : 0u);
        row = inside ? row : uvec2(0u);
        four |= row;
        if (dy < 3 && dz < 3) three |= row;
        if (dy < 2 && dz < 2) two |= row;
        if (i == 0) taken1 = row.x;
    }
    // A bit for each brick whose cube is not empty.
    uint taken2 = two.x | two.x >> 1 | two.y << 31;
    uint taken3 = three.x | three.x >> 1 | three.x >> 2 | three.y << 31 | three.y << 30;
    uint taken4 =
        four.x | four.x >> 1 | four.x >> 2 | four.x >> 3 | four.y << 31 | four.y << 30 | four.y << 29;
    uint left = used ? taken4 & ~taken1 : 0u;
    if (left == 0u) return;
    do {
        int i = findLSB(left);
        left &= left - 1u;
        ivec3 at = ivec3(32 * word + i, y, z);
        uint edge = (taken3 >> i & 1u) == 0u ? 3u : ((taken2 >> i & 1u) == 0u ? 2u : 1u);
        if (at.x < bricks.x)
            imageStore(octants, ivec3(octant * bricks.x + at.x, y, z), uvec4(edge, OCTANT_EMPTY, 0u, 0u));
    } while (left != 0u);
}
