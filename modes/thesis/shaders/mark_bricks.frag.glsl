#version 450 core
// SPDX-License-Identifier: MIT
// Fragment of a triangle seen along its dominant axis, a pixel per column of bricks -> marks of the bricks that
// the triangle's light may be summed in (voxelize.frag.glsl): those that it crosses within the column, and half a
// voxel beyond, which the two voxels share that it lies between. A few more, never less: what is summed in a
// brick without a mark would be lost.
#include "thesis/shaders/constants.h"
layout(std140) uniform ThesisGridBlock { ThesisGrid grid; };
#include "thesis/shaders/brick_slots.glsl"

layout(location = 0) flat in uvec3 constant;
layout(location = 1) flat in vec4 corner0;  // permuted position, in bricks
layout(location = 2) flat in vec4 corner1;
layout(location = 3) flat in vec4 corner2;

// Half a voxel, and a quarter of one for rounding, in bricks.
const float kReach = 0.75 / float(THESIS_BRICK);

vec3 permuted(vec3 v, uint axis) { return axis == 0u ? v.zyx : axis == 1u ? v.xzy : v; }

void main() {
    vec2 column = floor(gl_FragCoord.xy);
    vec3 a = corner0.xyz, b = corner1.xyz, c = corner2.xyz;
    // The triangle's plane over the column; it is less than 45 degrees steep.
    vec3 across = cross(b - a, c - a);
    vec2 slope = clamp(-across.xy / (abs(across.z) > 0.0 ? across.z : 1.0), -1.0, 1.0);
    float middle = a.z + dot(slope, column + 0.5 - a.xy);
    float reach = 0.5 * (abs(slope.x) + abs(slope.y));
    float nearest = min(min(a.z, b.z), c.z), farthest = max(max(a.z, b.z), c.z);
    float low = max(middle - reach, nearest), high = min(middle + reach, farthest);
    // Planes of slivers may be wrong by rounding.
    if (low > high || farthest - nearest < 1.0) {
        low = nearest;
        high = farthest;
    }
    int k = int(floor(low - kReach)), last = int(floor(high + kReach));
    do {
        ivec3 brick = ivec3(permuted(vec3(column, float(k)), constant.x)) - grid.boxMin.xyz / THESIS_BRICK;
        if (isInBox(brick * THESIS_BRICK)) atomicOr(brickSlots[brickIndex(brick)], 1u);
        ++k;
    } while (k <= last);
}
