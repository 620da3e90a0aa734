// SPDX-License-Identifier: MIT
// How much of a plane lies in a box: the areas that faces' bounds are fitted to (docs/theory/2_voxels.md,
// eq. 2.8).
#include "lib/dot.glsl"

// Share of a rectangle on which a plane lies below `height`, measured from the plane's height in the middle:
// the distribution function of a sum of two even ones. `rise`: what the plane rises along the two edges.
float shareBelow(vec2 rise, float height) {
    float a = max(max(rise.x, rise.y), 0.02);
    float b = max(min(rise.x, rise.y), 0.02);
    vec4 corner = max(height + 0.5 * vec4(a + b, b - a, a - b, -a - b), 0.0);
    corner *= corner;
    return clamp((corner.x - corner.y - corner.z + corner.w) / (2.0 * a * b), 0.0, 1.0);
}

// Area of a plane's piece within a box, seen along the third axis; n.z is the largest component. From the
// voxel's centre.
float pieceArea(vec3 n, float offset, vec3 lower, vec3 upper) {
    vec3 size = max(upper - lower, 0.0);
    float middle = (offset - dot(n.xy, 0.5 * (lower.xy + upper.xy))) / n.z;
    vec2 rise = abs(n.xy / n.z) * size.xy;
    return size.x * size.y *
           max(shareBelow(rise, upper.z - middle) - shareBelow(rise, lower.z - middle), 0.0);
}
