// SPDX-License-Identifier: MIT
// Update: one invocation per occupied brick. Voxels have new numbers; the chain of each is put under its own,
// with the number it had (origins; ~0 for voxels that were empty).
#version 450
layout(local_size_x = 64) in;
#include "lib/voxel_address.glsl"
#include "lib/voxel_grid.glsl"
#include "lib/voxel_record.glsl"
#include "voxels/surface_common.glsl"
#include "voxels/surface_scroll.glsl"
layout(std430) readonly buffer CounterTable { uint counters[]; };
layout(std430) readonly buffer BrickTable { uint brickList[]; };
layout(std430) readonly buffer OldChainTable { uvec2 oldChains[]; };
layout(std430) writeonly buffer ChainTable { uvec2 chains[]; };
layout(std430) writeonly buffer OriginTable { uint origins[]; };
uniform usampler3D brickWords;
uniform usampler3D oldBricks;

void main() {
    uint index = linearInvocation();
    bool used = index < min(counters[SURFACE_BRICKS], surface.brickCapacity);
    ivec3 brick = unpackVoxel(brickList[used ? index : 0u]);
    uvec4 word = texelFetch(brickWords, brick, 0);
#if NESTED_GRIDS
    int level = levelOfStored(4 * brick);
    ivec3 before = voxelBefore(withinLevel(4 * brick, level), level);
    bool held = isInLevel(before);
    uvec4 old = texelFetch(oldBricks, storedVoxel(held ? before : ivec3(0), level) >> 2, 0);
    old = held ? old : uvec4(0u);
#else
    uvec4 old = texelFetch(oldBricks, brick, 0);
#endif
    uvec2 bits = used ? word.xy : uvec2(0u);
    uint record = word.z;
    do {
        bool inLow = bits.x != 0u;
        bool alive = (bits.x | bits.y) != 0u;
        uint bit = alive ? uint(inLow ? findLSB(bits.x) : 32 + findLSB(bits.y)) : 0u;
        bool stood = (((bit & 32u) != 0u ? old.y : old.x) >> (bit & 31u) & 1u) != 0u;
        uint origin = stood ? voxelRecordIndex(old, bit) : 0u;
        uvec2 chain = stood && alive ? oldChains[origin] : uvec2(0u);
        if (alive && record < surface.voxelCapacity) {
            chains[record] = chain;
            origins[record] = stood ? origin : ~0u;
        }
        ++record;
        bits.y = inLow ? bits.y : bits.y & (bits.y - 1u);
        bits.x = inLow ? bits.x & (bits.x - 1u) : 0u;
    } while ((bits.x | bits.y) != 0u);
}
