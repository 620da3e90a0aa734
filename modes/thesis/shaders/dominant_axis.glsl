// SPDX-License-Identifier: MIT
// Coordinates as seen along the dominant axis of a triangle's normal, or along the one that `along` of ThesisGrid asks
// for.
#include "lib/dot.glsl"

// The axis along which a triangle is voxelized, by the sizes of its normal's parts. Ties: x before y before z, as in
// the original.
uint voxelizationAxis(vec3 weight, ivec4 along) {
    uint dominant = weight.x >= weight.y && weight.x >= weight.z ? 0u : weight.y >= weight.z ? 1u : 2u;
    return along.x < 3 ? uint(along.x) : dominant;
}

// Part of the surface that this pass takes. Three passes cover a triangle |n_k| times its area each; by shares of
// |n_k| max |n| that adds up to what the dominant axis covers alone.
float passShare(vec3 weight, uint axis, ivec4 along) {
    float largest = max(max(weight.x, weight.y), weight.z);
    return along.y != 0 ? weight[axis] * largest / max(dot(weight, weight), 1e-30) : 1.0;
}

// Area seen along each axis, in parts of that along `axis`; not more than 4, where a surface is seen edge on.
vec3 areasSeen(vec3 across, uint axis) {
    return clamp(across / max(abs(across[axis]), 1e-30), vec3(-4.0), vec3(4.0));
}

// The dominant axis last; its own inverse.
vec3 permuted(vec3 v, uint axis) { return axis == 0u ? v.zyx : axis == 1u ? v.xzy : v; }
