// SPDX-License-Identifier: MIT
// What the passes of the irradiance cache share that deal with the flux of faces, for the pool of light
// samples.
#include "lib/dot.glsl"
#include "lib/linear_index.glsl"
#include "lib/voxel_grid.glsl"
#include "lib/voxel_record.glsl"
#include "light/cache_state.glsl"
#include "shared/prefix_sum.h"
layout(std140) uniform CacheBlock { CacheConstants cache; };
layout(std430) buffer StateTable { FaceCache states[]; };
// Per chunk of faces: its flux, then the flux of all chunks before it.
layout(std430) buffer ChunkTable { float chunks[]; };

// Faces of a chunk, and chunks: as gpu::perChunk and gpu::chunksOf have them.
uint facesPerChunk() {
    return max((grid.faceCount + PREFIX_MOST_CHUNKS - 1u) / PREFIX_MOST_CHUNKS, PREFIX_LEAST_CHUNK);
}
uint chunkCount() { return (grid.faceCount + facesPerChunk() - 1u) / facesPerChunk(); }
