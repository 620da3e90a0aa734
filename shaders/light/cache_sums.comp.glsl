#version 450 core
// SPDX-License-Identifier: MIT
// The flux of faces in front of each chunk of them, for the pool of light samples (shared/prefix_sum.h).
//   STEP 0  one invocation per chunk: flux of faces -> its flux
//        1  one group: flux of chunks -> flux before each; behind them the total
#include "shared/prefix_sum.h"
#if STEP == 1
layout(local_size_x = PREFIX_GROUP) in;
#elif STEP == 0
layout(local_size_x = 64) in;
#else
#error STEP must be 0 or 1
#endif
#include "light/cache_common.glsl"
#if STEP == 0
uniform samplerBuffer faceFluxes;

void main() {
    uint chunk = linearIndex();
    if (chunk >= chunkCount()) return;
    uint each = facesPerChunk();
    uint face = chunk * each;
    uint end = min(face + each, grid.faceCount);
    float flux = 0.0;
    do {
        flux += texelFetch(faceFluxes, int(face)).x;
    } while (++face < end);
    chunks[chunk] = flux;
}
#else
#define PREFIX_TYPE float
#include "lib/prefix_sum.glsl"
layout(std430) writeonly buffer PoolTable { uint pool[]; };

void main() {
    uint count = chunkCount();
    float total = prefixChunks(count);
    if (gl_LocalInvocationIndex != 0u) return;
    chunks[count] = total;
    pool[0] = floatBitsToUint(total > 0.0 ? 1.0 / total : 0.0);
}
#endif
