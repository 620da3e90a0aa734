// SPDX-License-Identifier: MIT
// Which pixels share their directions (interleaved sampling, Keller and Heidrich 2001): those at one place of squares of
// 8x8. docs/theory/4e_pixels.md, "Directions".
#include "lib/random.glsl"

// Seed of the one sequence that all pixels have a part of: of 1, 3, 11 and 77 the one with least noise in a furnace.
const uint kPixelSequence = 1u;

// A pixel's shift of that sequence as a word, which costs rays one register. Any 2x2, 4x4 and 8x8 pixels, wherever they
// begin, have shifts that are evenly spread: in x and y a net of 4, 16 and 64 points (digits of base 2), in z 4, 16 and 64
// steps. Within its step z is random, by `seed`: of the entries of a pool one in 16 is another kind, which even steps would
// all meet or all miss (LIGHT_MOVED).
uint pixelShift(uvec2 pixel, uint seed) {
    uvec3 v = (pixel.yyy >> uvec3(0u, 1u, 2u)) & 1u;
    uvec3 u = ((pixel.xxx >> uvec3(0u, 1u, 2u)) & 1u) ^ v;
    uint x = u.x << 5 | u.y << 4 | (u.z ^ v.y) << 3 | (v.x ^ v.z) << 2 | v.y << 1 | v.x;
    uint y = v.x << 5 | v.y << 4 | (v.z ^ u.y) << 3 | (u.x ^ u.z) << 2 | u.y << 1 | u.x;
    uint z = (u.x ^ v.x) << 5 | u.x << 4 | (u.y ^ v.y) << 3 | u.y << 2 | (u.z ^ v.z) << 1 | u.z;
    return x | y << 6 | (randomHash(seed) >> 18) << 12 | z << 26;
}

// In [0,1)^3.
vec3 unpackShift(uint shift) {
    return vec3(shift & 63u, (shift >> 6) & 63u, shift >> 12) * vec3(1.0 / 64.0, 1.0 / 64.0, 1.0 / 1048576.0);
}

// The pixel of an invocation in groups of 8x8. 8x8 groups share a square of 64x64 pixels: each has those of one place, so
// that lanes of a GPU follow like rays. At the rim fewer groups share what is left.
ivec2 interleavedPixel() {
    uvec2 first = gl_WorkGroupID.xy & ~7u;
    uvec2 apart = min(uvec2(8u), gl_NumWorkGroups.xy - first);
    return ivec2(8u * first + gl_LocalInvocationID.xy * apart + gl_WorkGroupID.xy - first);
}
