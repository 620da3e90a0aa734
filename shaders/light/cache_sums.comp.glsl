#version 450 core
// SPDX-License-Identifier: MIT
// Flux of each chunk -> flux of all chunks before it; the total at the end. One invocation: sums have an
// order, and the list is short.
layout(local_size_x = 8) in;
#include "light/cache_common.glsl"
layout(std430) writeonly buffer PoolTable { uint pool[]; };

void main() {
    float total = 0.0;
    uint i = 0u;
    bool first = gl_GlobalInvocationID.x == 0u;
    do {
        float flux = chunks[i];
        if (first) chunks[i] = total;
        total += flux;
    } while (++i < cache.chunkCount);
    if (!first) return;
    chunks[cache.chunkCount] = total;
    pool[0] = floatBitsToUint(total > 0.0 ? 1.0 / total : 0.0);
}
