#version 450 core
// SPDX-License-Identifier: MIT
// How far it is empty around each empty brick, REACH bricks to each side: 1 where its neighbours are empty,
// 2R where R bricks are about the eight corners of R. In place: what other invocations write meanwhile passes
// the same test. Outside of the grid it is empty.
#ifndef REACH
#error REACH must be the reach that is looked for: 1, 2, 4 ...
#endif
layout(local_size_x = 8, local_size_y = 4, local_size_z = 4) in;
layout(rgba32ui) uniform uimage3D occupied;

void main() {
    ivec3 brick = ivec3(gl_GlobalInvocationID);
    ivec3 last = imageSize(occupied) - 1;
    if (any(greaterThan(brick, last))) return;
    bool holds = true;
#if REACH == 1
    for (int i = 0; i < 27; ++i) {
        ivec3 other = clamp(brick + ivec3(i % 3, i / 3 % 3, i / 9) - 1, ivec3(0), last);
        uvec4 word = imageLoad(occupied, other);
        holds = holds && (word.x | word.y) == 0u;
    }
#else
    for (int i = 0; i < 8; ++i) {
        ivec3 corner = REACH / 2 * (2 * (ivec3(i, i >> 1, i >> 2) & 1) - 1);
        holds = holds && imageLoad(occupied, clamp(brick + corner, ivec3(0), last)).z >= uint(REACH / 2);
    }
#endif
    if (holds) imageStore(occupied, brick, uvec4(0u, 0u, REACH, 0u));
}
