// SPDX-License-Identifier: MIT
// Sample points of a rectangular light, on its 16 x 16 squares: point k lies in column k and row
// RECT_POINT_ROW(k). One in each row and column, so that an edge parallel to the rectangle meets them one by
// one, and of all such sets the one found by annealing that errs least for edges in the worst direction: the
// share of points on one side differs from the share of area by 3.6 % RMS there, 3.1 % over all directions. A
// sheared grid of 4 x 4 has 6.3 % and 4.2 %: four of its points lie on lines 14 degrees off the sides.
//
// Round ones, disks and spheres, have 16 points of their own: 8 bits signed-normalised each of x, y, z, lowest first.
// Seen from any side those of a sphere cover its disc evenly, as do points of the unit sphere of four dimensions with
// one coordinate left out. A disk has their x and y. Annealed, too: the share on one side of an edge errs by 3.6 % RMS
// over all directions of a sphere, by 5.3 % in the worst, and by 3.2 % and 3.7 % of a disk.
#pragma once
#include "shared/prelude.h"

#define RECT_POINT_COUNT 16u
#define RECT_POINT_ROW(k) ((((k) < 8u ? 0x2f7b0c48u : 0x3ae61d95u) >> (4u * ((k)&7u))) & 15u)
#define ROUND_POINT_COUNT 16u
CONELIGHT_SHARED_BEGIN
const uint kRoundPoints[ROUND_POINT_COUNT] = {
    0x32c64au, 0xccea5du, 0xe99c25u, 0x142264u, 0x5f3c0cu, 0x9b11dfu, 0xdf5de3u, 0x5dee0fu,
    0xacc9f5u, 0x379eeau, 0xde189au, 0x2c3db5u, 0x46ebadu, 0xe3b8b3u, 0x0a6626u, 0xae2e3au};
CONELIGHT_SHARED_END
