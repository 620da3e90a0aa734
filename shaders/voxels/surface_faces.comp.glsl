// SPDX-License-Identifier: MIT
// Last third of the prefix sum over voxels: voxRec of each voxel, and for each face where its
// voxel's chain starts and its direction (29 bits | 3 bits above).
#version 450
layout(local_size_x = 64) in;
#include "voxels/surface_common.glsl"
layout(std430, binding = SURFACE_COUNTERS) readonly buffer CounterTable { uint counters[]; };
layout(std430, binding = SURFACE_CHAINS) readonly buffer ChainTable { uvec2 chains[]; };
layout(std430, binding = SURFACE_CHUNKS) readonly buffer ChunkTable { uvec2 chunks[]; };
layout(std430, binding = SURFACE_OWNERS) writeonly buffer OwnerTable { uint owners[]; };
layout(std430, binding = BINDING_VOXEL_RECORDS) writeonly buffer RecordTable { uint records[]; };

void main() {
    uint count = min(counters[SURFACE_VOXELS], surface.voxelCapacity);
    uint chunk = linearInvocation();
    uint i = chunk * surface.voxelsPerChunk;
    uint end = min(i + surface.voxelsPerChunk, count);
    uint next = i < end ? chunks[chunk].x : 0u;
    while (i < end) {
        uvec2 chain = chains[i];
        uint directions = chain.y;
        records[i] = min(next, 0x3ffffffu) | (directions << 26);
        uint remaining = directions;
        // Most voxels have one to three of the six.
        while (remaining != 0u) {
            if (next < surface.faceCapacity) owners[next] = chain.x | (uint(findLSB(remaining)) << 29);
            remaining &= remaining - 1u;
            ++next;
        }
        ++i;
    }
}
