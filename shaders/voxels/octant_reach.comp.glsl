#version 450 core
// SPDX-License-Identifier: MIT
// octWord: reach R / 2 -> R where the eight cubes of edge R / 2 ahead are empty. In place: what other
// invocations write meanwhile, R in place of R / 2, passes the same test.
#ifndef REACH
#error REACH must be the reach that is looked for: 2, 4 ...
#endif
layout(local_size_x = 8, local_size_y = 4, local_size_z = 4) in;
#include "lib/voxel_grid.glsl"
layout(binding = 0, rg32ui) uniform uimage3D octants;

void main() {
    ivec3 at = ivec3(gl_GlobalInvocationID);
    ivec3 bricks = gridBricks();
    if (any(greaterThanEqual(at, ivec3(8 * bricks.x, bricks.yz)))) return;
    int octant = at.x / bricks.x;
    ivec3 brick = ivec3(at.x - octant * bricks.x, at.yz);
    uint least = REACH / 2;
    for (int corner = 0; corner < 8; ++corner) {
        ivec3 other = brick + REACH / 2 * (ivec3(corner, corner >> 1, corner >> 2) & 1);
        bool inside = all(lessThan(other, bricks));
        uvec2 word = imageLoad(octants, ivec3((inside ? other.x : brick.x) + octant * bricks.x,
                                              inside ? other.yz : brick.yz))
                         .xy;
        uint reach = word.y == OCTANT_EMPTY ? word.x : 0u;
        least = inside || corner == 0 ? min(least, reach) : least;
    }
    if (least == REACH / 2) imageStore(octants, at, uvec4(REACH, OCTANT_EMPTY, 0u, 0u));
}
