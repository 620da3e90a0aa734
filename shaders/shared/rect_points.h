// SPDX-License-Identifier: MIT
// Sample points of a rectangular light, on its 16 x 16 squares: point k lies in column k and row
// RECT_POINT_ROW(k). One in each row and column, so that an edge parallel to the rectangle meets them one by
// one, and of all such sets the one found by annealing that errs least for edges in the worst direction: the
// share of points on one side differs from the share of area by 3.6 % RMS there, 3.1 % over all directions. A
// sheared grid of 4 x 4 has 6.3 % and 4.2 %: four of its points lie on lines 14 degrees off the sides.
#pragma once

#define RECT_POINT_COUNT 16u
#define RECT_POINT_ROW(k) ((((k) < 8u ? 0x2f7b0c48u : 0x3ae61d95u) >> (4u * ((k)&7u))) & 15u)
