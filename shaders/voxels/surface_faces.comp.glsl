// SPDX-License-Identifier: MIT
// Last third of the prefix sum over voxels: voxRec of each voxel, and for each face where its
// voxel's chain starts and its direction (29 bits | 3 bits above).
// SURFACE_UPDATE 1: faces of voxels whose fragments stayed name the face they were before instead (29 bits,
// above them OWNER_IS_FACE; surface_copy); the others are put on the list of surface_resolve. Copying them
// here took 8 to 35 % more: lanes wait for the one with most faces.
#version 450
#ifndef SURFACE_UPDATE
#error SURFACE_UPDATE must be 0 or 1
#endif
layout(local_size_x = 64) in;
#include "voxels/surface_common.glsl"
#if SURFACE_UPDATE
layout(std430) buffer CounterTable { uint counters[]; };
layout(std430) buffer ChainTable { uvec2 chains[]; };
layout(std430) readonly buffer OriginTable { uint origins[]; };
layout(std430) writeonly buffer WorkTable { uint work[]; };
uniform usamplerBuffer oldRecords;
#else
layout(std430) readonly buffer CounterTable { uint counters[]; };
layout(std430) readonly buffer ChainTable { uvec2 chains[]; };
#endif
layout(std430) readonly buffer ChunkTable { uvec2 chunks[]; };
layout(std430) writeonly buffer OwnerTable { uint owners[]; };
layout(std430) writeonly buffer RecordTable { uint records[]; };

void main() {
    uint count = min(counters[SURFACE_VOXELS], surface.voxelCapacity);
    uint chunk = linearInvocation();
    uint i = chunk * surface.voxelsPerChunk;
    uint end = min(i + surface.voxelsPerChunk, count);
    uint next = i < end ? chunks[chunk].x : 0u;
    while (i < end) {
        uvec2 chain = chains[i];
        uint directions = chain.y & CHAIN_DIRECTIONS;
#if SURFACE_UPDATE
        bool edited = (chain.y & CHAIN_EDITED) != 0u;
        if (edited) chains[i].y = directions;
        // A voxel that is not edited was there before, with the same directions.
        uint old = texelFetch(oldRecords, edited ? 0 : int(origins[i])).x & 0x3ffffffu;
#endif
        records[i] = min(next, 0x3ffffffu) | (directions << 26);
        uint remaining = directions;
        // Most voxels have one to three of the six.
        while (remaining != 0u) {
            uint owner = chain.x | (uint(findLSB(remaining)) << 29);
#if SURFACE_UPDATE
            owner = edited ? owner : old | (OWNER_IS_FACE << 29);
            ++old;
            if (edited && next < surface.faceCapacity) work[atomicAdd(counters[SURFACE_WORK], 1u)] = next;
#endif
            if (next < surface.faceCapacity) owners[next] = owner;
            remaining &= remaining - 1u;
            ++next;
        }
        ++i;
    }
}
