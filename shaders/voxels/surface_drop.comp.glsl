// SPDX-License-Identifier: MIT
// Update: one invocation per voxel of each edited brick. Takes the fragments of changed instances out of the
// voxel's chain, puts their slots on the list of free ones, and finds anew in which directions the rest
// faces. A voxel with nothing left is empty. When nested grids move, all fragments go of bricks that leave
// their level.
#version 450
layout(local_size_x = 64) in;
#include "lib/voxel_address.glsl"
#include "lib/voxel_grid.glsl"
#include "lib/voxel_record.glsl"
#include "voxels/surface_common.glsl"
#include "voxels/surface_scroll.glsl"
layout(std430) buffer CounterTable { uint counters[]; };
layout(std430) readonly buffer EditedTable { uint editedBricks[]; };
layout(std430) buffer ChangedTable { uint changedBricks[]; };
layout(std430) readonly buffer StaleTable { uint stale[]; };
layout(std430) buffer MaskTable { uint masks[]; };
layout(std430) buffer ChainTable { uvec2 chains[]; };
layout(std430) buffer FragmentTable { uint fragments[]; };
layout(std430) writeonly buffer FreeTable { uint freeSlots[]; };
uniform usampler3D brickWords;
uniform samplerBuffer triangles;
uniform usamplerBuffer pairs;

// Directions in which a stored fragment counts, none without area (surface_clip).
uint storedDirections(uint base) {
    uint xy = fragments[base + 3u];
    vec3 n = vec3(unpackSnorm16(xy), unpackSnorm16(xy >> 16), unpackSnorm16(fragments[base + 4u]));
    bool twoSided = (fragments[base + 2u] & FRAGMENT_TWO_SIDED) != 0u;
    uint directions = facingDirections(n) | (twoSided ? facingDirections(-n) : 0u);
    return fragments[base + 1u] != 0u ? directions : 0u;
}

void main() {
    uint index = linearInvocation();
    bool used = index < 64u * surface.editedBricks;
    uint brick = editedBricks[used ? index >> 6 : 0u];
    uint bit = index & 63u;
    uvec4 word = texelFetch(brickWords, brickOfIndex(brick, gridBricks()), 0);
    bool occupied = used && (((bit & 32u) != 0u ? word.y : word.x) >> (bit & 31u) & 1u) != 0u;
    uint record = occupied ? voxelRecordIndex(word, bit) : 0u;
    bool leaves = false;
#if NESTED_GRIDS
    ivec3 stored = 4 * brickOfIndex(brick, gridBricks());
    int level = levelOfStored(stored);
    leaves = !staysHeld(withinLevel(stored, level), level);
#endif

    uint at = occupied ? chains[record].x : 0u;
    uint head = 0u;
    uint last = 0u;
    uint directions = 0u;
    bool dropped = false;
    do {
        uint slot = max(at, 1u) - 1u;
        uint base = 8u * slot;
        uint next = at != 0u ? fragments[base] : 0u;
        int triangle = int(texelFetch(pairs, int(slot)).x);
        uint instance = floatBitsToUint(texelFetch(triangles, 3 * triangle).w) & 0xffffffu;
        bool goes = at != 0u && (leaves || (stale[instance >> 5] >> (instance & 31u) & 1u) != 0u);
        bool stays = at != 0u && !goes;
        if (goes) {
            freeSlots[atomicAdd(counters[SURFACE_FREE], 1u)] = slot;
            fragments[base + 1u] = 0u;  // no area: whoever goes through all slots passes it over
        }
        dropped = dropped || goes;
        if (stays && last != 0u) fragments[8u * (last - 1u)] = at;
        head = stays && last == 0u ? at : head;
        last = stays ? at : last;
        directions |= stays ? storedDirections(base) : 0u;
        at = next;
    } while (at != 0u);
    if (dropped) {
        if (last != 0u) fragments[8u * (last - 1u)] = 0u;
        chains[record] = uvec2(head, directions | CHAIN_EDITED);
        if (head == 0u) atomicAnd(masks[2u * brick + (bit >> 5)], ~(1u << (bit & 31u)));
        atomicOr(changedBricks[brick >> 5], 1u << (brick & 31u));
    }
}
