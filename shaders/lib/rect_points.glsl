// SPDX-License-Identifier: MIT
// Where the sample points of a rectangle of light lie (shared/rect_points.h), in [-1,1] along halfU and
// halfV.
#include "shared/rect_points.h"

vec2 rectPointPlace(uint k) {
    return (vec2(k, RECT_POINT_ROW(k)) + 0.5) * (2.0 / float(RECT_POINT_COUNT)) - 1.0;
}
