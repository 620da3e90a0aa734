// SPDX-License-Identifier: MIT
// Which faces of the cache share their directions (interleaved sampling, Keller and Heidrich 2001): a voxel's
// place in its brick, turned about in each brick by a hash. Without the turn what is left of the noise would
// repeat every four voxels, as a weave. docs/theory/4d_cache.md, "Directions".
#include "lib/random.glsl"

// 0 to 3 along each axis; the 64 voxels of a brick have 64 places. Along `axis`, that of the face's
// direction, nothing turns: a wall's faces share 16 places, not 64.
uvec3 interleavedPlace(uvec3 voxel, uint axis) {
    uvec3 brick = voxel >> 2;
    uint turn = randomHash(brick.x | brick.y << 10 | brick.z << 20);
    uvec3 turns = uvec3(axis == 0u ? 0u : turn, axis == 1u ? 0u : turn >> 2, axis == 2u ? 0u : turn >> 4);
    return (voxel ^ turns) & 3u;
}
