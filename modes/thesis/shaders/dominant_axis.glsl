// SPDX-License-Identifier: MIT
// Coordinates as seen along the dominant axis of a triangle's normal.

// The dominant axis last; its own inverse.
vec3 permuted(vec3 v, uint axis) { return axis == 0u ? v.zyx : axis == 1u ? v.xzy : v; }
