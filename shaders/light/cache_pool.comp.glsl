#version 450 core
// SPDX-License-Identifier: MIT
// Draws the pool of light samples: each entry is the face at a random place in one of equal parts of the
// total flux (stratified), in their order but for close neighbours. Finds its chunk by bisection, then walks
// through the chunk.
layout(local_size_x = 64) in;
#include "lib/random.glsl"
#include "light/cache_common.glsl"
layout(std430) writeonly buffer PoolTable { uint pool[]; };
uniform samplerBuffer faceFluxes;

void main() {
    uint place = min(gl_GlobalInvocationID.x, LIGHT_SAMPLE_COUNT - 1u);
    // Neighbours alternate as voxels do, two layers of a lamp for example, and evenly spread numbers would
    // find the same one everywhere: within groups of 8 and 64 they are exchanged at random.
    uint entry = place ^ (randomHash(place >> 3) & 7u);
    entry ^= randomHash(entry >> 6) & 56u;
    uint chunkTotal = chunkCount();
    float total = chunks[chunkTotal];
    uint state = randomHash(entry ^ randomHash(cache.update ^ randomHash(cache.seed ^ 0x51ed270bu)));
    float wanted = (float(entry) + randomNext(state)) * (total / float(LIGHT_SAMPLE_COUNT));
    uint low = 0u;
    uint high = chunkTotal;
    do {
        uint middle = (low + high) / 2u;
        bool above = chunks[middle] <= wanted;
        low = above ? middle : low;
        high = above ? high : middle;
    } while (high - low > 1u);
    uint each = facesPerChunk();
    uint face = low * each;
    uint end = min(face + each, grid.faceCount);
    float sum = chunks[low];
    // The last face with any flux stands in where rounding overshoots.
    uint found = face;
    bool going = true;
    do {
        float flux = texelFetch(faceFluxes, int(face)).x;
        found = flux > 0.0 ? face : found;
        sum += flux;
        going = sum <= wanted;
    } while (++face < end && going);
    pool[1u + place] = found;
}
