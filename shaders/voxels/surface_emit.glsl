// SPDX-License-Identifier: MIT
// Writes fragments: marks the voxel in its brick's mask and appends (triangle, voxel) to the list.
#include "lib/clip.glsl"
#include "lib/voxel_address.glsl"
#include "lib/voxel_grid.glsl"
#include "voxels/surface_columns.glsl"
layout(std430) buffer CounterTable { uint counters[]; };
layout(std430) writeonly buffer PairTable { uvec2 pairs[]; };
#if SURFACE_UPDATE
layout(std430) readonly buffer FreeTable { uint freeSlots[]; };
#endif
layout(std430) buffer MaskTable { uint masks[]; };

// The columns of one invocation, row after row, in dominant-axis coordinates.
struct ColumnBlock {
    ivec3 anchor;  // voxel of cell (0,0)
    int axis;      // the dominant one
    int width;     // cells per row
    int depth;     // cells per column that the triangle's bounds leave
};

// bits: the cells that the triangle meets, four bits per column (columnMask).
void emitFragments(ColumnTest t, uint triangle, uvec2 bits, ColumnBlock block) {
    uint total = uint(bitCount(bits.x) + bitCount(bits.y));
    uint slot = 0u;
    if (total != 0u) slot = atomicAdd(counters[SURFACE_FRAGMENTS], total);
    ivec3 bricks = gridBricks();
    float perWidth = 1.0 / float(block.width);
    do {
        // The voxel of the lowest bit that is left.
        bool inLow = bits.x != 0u;
        int bit = inLow ? findLSB(bits.x) : 32 + findLSB(bits.y);
        bool alive = (bits.x | bits.y) != 0u;
        int column = bit >> 2;
        int row = int((float(column) + 0.5) * perWidth);
        ivec2 cell = ivec2(column - row * block.width, row);
        int first;
        columnCandidates(t, vec2(cell), block.depth, first);
        ivec3 voxel = fromDominant(block.anchor + ivec3(cell, first + (bit & 3)), block.axis);
        if (alive) {
            uint b = bitOfVoxel(voxel);
            atomicOr(masks[2u * brickIndex(voxel >> 2, bricks) + (b >> 5)], 1u << (b & 31u));
        }
#if SURFACE_UPDATE
        uint place = alive ? FRAGMENT_SLOT(slot) : 0u;
#else
        uint place = slot;
#endif
        if (alive && place < surface.fragmentCapacity) pairs[place] = uvec2(triangle, packVoxel(voxel));
        ++slot;
        bits.y = inLow ? bits.y : bits.y & (bits.y - 1u);
        bits.x = inLow ? bits.x & (bits.x - 1u) : 0u;
    } while ((bits.x | bits.y) != 0u);
}
