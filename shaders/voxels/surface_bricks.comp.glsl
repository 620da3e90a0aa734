// SPDX-License-Identifier: MIT
// Last third of the prefix sum over bricks: occupancy and first voxel record of each occupied brick into
// brickWord (cleared before), and the list of occupied bricks.
#version 450
layout(local_size_x = 64) in;
#include "lib/voxel_address.glsl"
#include "lib/voxel_grid.glsl"
#include "voxels/surface_common.glsl"
layout(std430) readonly buffer MaskTable { uvec2 masks[]; };
layout(std430) readonly buffer ChunkTable { uvec2 chunks[]; };
layout(std430) writeonly buffer BrickTable { uint brickList[]; };
layout(rgba32ui) uniform writeonly uimage3D brickWords;

void main() {
    ivec3 bricks = gridBricks();
    uint count = storedBrickCount();
    uint chunk = linearInvocation();
    uint i = chunk * surface.bricksPerChunk;
    uint end = min(i + surface.bricksPerChunk, count);
    uvec2 next = i < end ? chunks[chunk] : uvec2(0u);
    // Counted along: an integer division per brick would cost more than the rest.
    ivec3 brick = brickOfIndex(i, bricks);
    while (i < end) {
        uvec2 mask = masks[i];
        bool occupied = (mask.x | mask.y) != 0u;
        if (occupied) {
            imageStore(brickWords, brick, uvec4(mask, next.x, 0u));
            if (next.y < surface.brickCapacity) brickList[next.y] = packVoxel(brick);
        }
        next += uvec2(uint(bitCount(mask.x) + bitCount(mask.y)), occupied ? 1u : 0u);
        ++i;
        bool rowEnds = brick.x + 1 == bricks.x;
        bool sliceEnds = rowEnds && brick.y + 1 == bricks.y;
        brick = sliceEnds ? ivec3(0, 0, brick.z + 1)
                          : (rowEnds ? ivec3(0, brick.y + 1, brick.z) : ivec3(brick.x + 1, brick.yz));
    }
}
