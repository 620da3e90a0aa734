// SPDX-License-Identifier: MIT
// Addresses of voxels: bricks of 4^3, bits. C++ twin: src/voxels/voxel_grid.h.
// World and grid coordinates: lib/voxel_grid.glsl.

// Linear brick index, x fastest.
uint brickIndex(ivec3 brick, ivec3 bricks) {
    return uint(brick.x + bricks.x * (brick.y + bricks.y * brick.z));
}

ivec3 brickOfIndex(uint index, ivec3 bricks) {
    int i = int(index);
    int row = i / bricks.x;
    return ivec3(i - row * bricks.x, row % bricks.y, row / bricks.y);
}

// Bit of a voxel in its brick, x fastest, 0..63.
uint bitOfVoxel(ivec3 voxel) { return uint((voxel.x & 3) | ((voxel.y & 3) << 2) | ((voxel.z & 3) << 4)); }

ivec3 voxelOfBit(ivec3 brick, uint bit) {
    int b = int(bit);
    return 4 * brick + ivec3(b & 3, (b >> 2) & 3, b >> 4);
}

// Three coordinates of 10 bits each.
uint packVoxel(ivec3 voxel) { return uint(voxel.x | (voxel.y << 10) | (voxel.z << 20)); }
ivec3 unpackVoxel(uint bits) {
    int b = int(bits & 0x3fffffffu);
    return ivec3(b & 1023, (b >> 10) & 1023, b >> 20);
}

// Whether bit `bit` is set in a brick's occupancy (lo, hi).
bool brickHas(uvec2 mask, uint bit) { return (((bit < 32u ? mask.x : mask.y) >> (bit & 31u)) & 1u) != 0u; }

// How many occupied voxels lie below bit `bit`.
uint brickRank(uvec2 mask, uint bit) {
    uint below = (1u << (bit & 31u)) - 1u;
    return bit < 32u ? uint(bitCount(mask.x & below))
                     : uint(bitCount(mask.x)) + uint(bitCount(mask.y & below));
}

// Index of the record of an occupied voxel, from its brick's texel of brickWord.
uint voxelRecordIndex(uvec4 brickWord, uint bit) { return brickWord.z + brickRank(brickWord.xy, bit); }

// Index of the first face and the directions present (bit k), from voxRec.
uint faceBase(uint record) { return record & 0x3ffffffu; }
uint faceDirections(uint record) { return record >> 26; }
// Index of the face in direction k of a voxel that has one.
uint faceIndex(uint record, int direction) {
    return faceBase(record) + uint(bitCount(faceDirections(record) & ((1u << direction) - 1u)));
}
