// SPDX-License-Identifier: MIT
// Runs of bricks along x: a block of lib/light_cells.glsl is as many of them as it has bricks along y times z. Faces are stored
// by brick, x fastest, so that those of a run are next to each other. For the passes that draw light samples.
#include "lib/light_cells.glsl"
uniform samplerBuffer faceFluxes;  // sidedFlux
uniform usampler3D voxelBricks;
uniform usamplerBuffer voxelRecords;

uint runCount() {
    ivec3 bricks = storedBricks();
    return uint(kLightBlocks * bricks.y * bricks.z);
}

// Run (y, z) of a block, below 1 << blockShift(), as a place in their table; -1: it lies outside of the grid.
int runOfBlock(ivec3 block, int level, ivec2 within) {
    int shift = blockShift();
    ivec2 at = (block.yz << shift) + within;
    ivec3 bricks = gridBricks();
    bool inside = all(lessThan(at, bricks.yz)) && block.x << shift < bricks.x;
    return inside ? block.x + kLightBlocks * (at.x + bricks.y * (at.y + level * bricks.z)) : -1;
}

// First face of a run, and the one behind its last.
ivec2 facesOfRun(int run) {
    int line = run / kLightBlocks;
    int lines = storedBricks().y;
    ivec3 brick = ivec3((run & (kLightBlocks - 1)) << blockShift(), line % lines, line / lines);
    int end = min(brick.x + (1 << blockShift()), storedBricks().x);
    ivec2 records = ivec2(0);
    while (brick.x < end) {
        uvec4 word = texelFetch(voxelBricks, brick, 0);
        int count = bitCount(word.x) + bitCount(word.y);
        ivec2 own = int(word.z) + ivec2(0, count);
        if (count > 0) records = ivec2(records.x == records.y ? own.x : records.x, own.y);
        ++brick.x;
    }
    bool any = records.x < records.y;
    uint first = texelFetch(voxelRecords, any ? records.x : 0).x;
    uint last = texelFetch(voxelRecords, any ? records.y - 1 : 0).x;
    int behind = int(faceBase(last)) + bitCount(faceDirections(last));
    return any ? ivec2(int(faceBase(first)), behind) : ivec2(0);
}
