// SPDX-License-Identifier: MIT
// Rows of bricks along x, per octant, in its mirrored coordinates: a bit for each brick that holds a face
// towards the octant. octant_masks writes them, octant_reach reads them.

// Words per row.
int octantRowWords(ivec3 bricks) { return (bricks.x + 31) / 32; }
// Place of a word; at.x counts words.
int octantRow(int octant, ivec3 at, ivec3 bricks) {
    return ((octant * bricks.z + at.z) * bricks.y + at.y) * octantRowWords(bricks) + at.x;
}
