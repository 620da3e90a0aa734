#version 450 core
// SPDX-License-Identifier: MIT
// Triangles -> marks of the bricks that their light may be summed in (voxelize.comp.glsl): those that a triangle
// crosses, and half a voxel beyond, as the two voxels share light that it lies between. A few more, never less: what
// is summed in a brick without a mark would be lost. And how many columns of bricks wide triangles touch.
// One invocation per triangle.
#include "lib/dot.glsl"
#include "thesis/shaders/constants.h"
layout(local_size_x = 64) in;
#include "lib/linear_index.glsl"
layout(std140) uniform ThesisGridBlock { ThesisGrid grid; };
#include "thesis/shaders/brick_slots.glsl"
#include "thesis/shaders/scene_triangle.glsl"
// [1] number of tiles
layout(std430) buffer BrickList { uint brickList[]; };

// Half a voxel, and a quarter of one for rounding.
const float kReach = 0.75;

// Bricks along the dominant axis, in a column.
ivec2 bricksInColumn(GridTriangle t, ivec2 column) {
    // The triangle's plane over the column; along its dominant axis it is at most 45 degrees steep.
    vec3 n = cross(t.b - t.a, t.c - t.a);
    vec2 slope = clamp(-n.xy / (abs(n.z) > 0.0 ? n.z : 1.0), -1.0, 1.0);
    float middle = t.a.z + dot(slope, (vec2(column) + 0.5) * float(THESIS_BRICK) - t.a.xy);
    float extent = 0.5 * float(THESIS_BRICK) * (abs(slope.x) + abs(slope.y));
    float nearest = min(min(t.a.z, t.b.z), t.c.z), farthest = max(max(t.a.z, t.b.z), t.c.z);
    float low = max(middle - extent, nearest), high = min(middle + extent, farthest);
    // Planes of slivers may be wrong by rounding, those along another axis steeper.
    bool isFlat = grid.along.x < 3 || low > high || farthest - nearest < float(THESIS_BRICK);
    vec2 ends = isFlat ? vec2(nearest, farthest) : vec2(low, high);
    ends = clamp(ends, vec2(-1e6), vec2(1e6));
    return ivec2(floor((ends + vec2(-kReach, kReach)) / float(THESIS_BRICK)));
}

void main() {
    GridTriangle t = gridTriangle(linearIndex());
    ColumnWalk walk = startColumns(t);
    ivec2 column;
    uint tiles = 0u;
    bool found = nextColumn(t, walk, column);
    while (found) {
        ++tiles;
        ivec2 k = bricksInColumn(t, column);
        // Within the grid; isInBox asks for more.
        k = clamp(k, ivec2(-1), ivec2(int(grid.size) / THESIS_BRICK));
        do {
            ivec3 brick = ivec3(permuted(vec3(column, k.x), t.axis)) - grid.boxMin.xyz / THESIS_BRICK;
            if (isInBox(brick * THESIS_BRICK)) {
                uint index = brickIndex(brick);
                if (brickSlots[index] == 0u) atomicOr(brickSlots[index], 1u);
            }
            ++k.x;
        } while (k.x <= k.y);
        found = nextColumn(t, walk, column);
    }
    if (t.isWide && tiles > 0u) atomicAdd(brickList[1], tiles);
}
