// SPDX-License-Identifier: MIT
// Writes fragments: marks the voxel in its brick's mask and appends (triangle, voxel) to the list.
#include "lib/clip.glsl"
#include "lib/voxel_address.glsl"
#include "lib/voxel_grid.glsl"
#include "voxels/surface_columns.glsl"
#if SURFACE_UPDATE
#include "voxels/surface_scroll.glsl"
#endif
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

#if NESTED_GRIDS
// The level that is voxelized, and its part in the word of a tile.
int emitLevel = 0;
#if SURFACE_UPDATE
layout(std430) readonly buffer StaleTable { uint stale[]; };
// Whether the triangle is of an instance that changed: others are listed only in voxels that a level has not held.
bool emitHeld = true;
bool isStale(uint instance) { return (stale[instance >> 5] >> (instance & 31u) & 1u) != 0u; }
#endif
#define TILE_LEVEL_SHIFT 24
#define TILE_WORD(x, y) (uint(x) | uint(y) << 12 | uint(emitLevel) << TILE_LEVEL_SHIFT)
#define TILE_COLUMN(word) ivec2(int((word)&0xfffu), int((word) >> 12 & 0xfffu))
#else
#define TILE_WORD(x, y) (uint(x) | (uint(y) << 16))
#define TILE_COLUMN(word) ivec2(int((word)&0xffffu), int((word) >> 16))
#endif

// The voxel of the lowest of the bits.
ivec3 lowestVoxel(ColumnTest t, uvec2 bits, ColumnBlock block, float perWidth) {
    bool inLow = bits.x != 0u;
    int bit = inLow ? findLSB(bits.x) : 32 + findLSB(bits.y);
    int column = bit >> 2;
    int row = int((float(column) + 0.5) * perWidth);
    ivec2 cell = ivec2(column - row * block.width, row);
    int first;
    columnCandidates(t, vec2(cell), block.depth, first);
    return fromDominant(block.anchor + ivec3(cell, first + (bit & 3)), block.axis);
}

#if NESTED_GRIDS
// The bits of cells that the next finer level does not hold, and that are listed (emitHeld).
uvec2 outsideFiner(ColumnTest t, uvec2 bits, ColumnBlock block, float perWidth) {
    ivec3 lowest, end;
    finerVoxels(emitLevel, lowest, end);
    uvec2 left = bits;
    uvec2 outside = uvec2(0u);
    do {
        ivec3 voxel = lowestVoxel(t, left, block, perWidth);
        bool finer = isWithin(voxel, lowest, end);
#if SURFACE_UPDATE
        finer = finer || (!emitHeld && wasHeld(voxel, emitLevel));
#endif
        uvec2 bit = left.x != 0u ? uvec2(left.x & (0u - left.x), 0u) : uvec2(0u, left.y & (0u - left.y));
        outside |= finer ? uvec2(0u) : bit;
        left ^= bit;
    } while ((left.x | left.y) != 0u);
    return outside;
}
#endif

// bits: the cells that the triangle meets, four bits per column (columnMask).
void emitFragments(ColumnTest t, uint triangle, uvec2 bits, ColumnBlock block) {
    float perWidth = 1.0 / float(block.width);
#if NESTED_GRIDS
    bits = outsideFiner(t, bits, block, perWidth);
#endif
    uint total = uint(bitCount(bits.x) + bitCount(bits.y));
    uint slot = 0u;
    if (total != 0u) slot = atomicAdd(counters[SURFACE_FRAGMENTS], total);
    ivec3 bricks = gridBricks();
    do {
        // The voxel of the lowest bit that is left.
        bool inLow = bits.x != 0u;
        bool alive = (bits.x | bits.y) != 0u;
        ivec3 voxel = lowestVoxel(t, bits, block, perWidth);
#if NESTED_GRIDS
        voxel = storedVoxel(voxel, emitLevel);
#endif
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
