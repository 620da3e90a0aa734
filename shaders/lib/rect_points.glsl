// SPDX-License-Identifier: MIT
// Where the sample points of a rectangle of light lie, in [-1,1] along halfU and halfV: 16, the default,
// where shared/rect_points.h says; another number, grid^2, one per cell of a grid, at places that differ in
// both coordinates (Chiu et al. 1994, "Multi-Jittered Sampling", without the jitter). C++ twin:
// rectSamplePoint in src/light/shadow_maps.cpp.
#include "shared/rect_points.h"

vec2 rectPointPlace(uint k, uint grid) {
    uint count = grid * grid;
    uint row = count == RECT_POINT_COUNT ? RECT_POINT_ROW(k) : (k % grid) * grid + k / grid;
    return (vec2(k, row) + 0.5) * (2.0 / float(count)) - 1.0;
}
