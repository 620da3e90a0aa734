// SPDX-License-Identifier: MIT
// Where the cells of the grid (shared/irradiance.h) see the sky, as updates of the cache have learned (src/light/sky_guide.h).
//
//   skyLearned  uints, SKY_LEARNED_WORDS per row: what cosine-sampled rays of faces found
//   skyGuide    uints, SKY_GUIDE_WORDS per row: where rays of pixels are sent
#pragma once

// Directions are cut into bins, a grid of so many a side over the octahedral map (lib/octahedral.glsl).
#define SKY_BINS_ACROSS 16
#define SKY_BINS 256  // a byte tells one
// Of a row: bins, in proportion to the sky that was found there.
#define SKY_SLOTS 128
#define SKY_ROW_LANES 64  // invocations for a row
#define SKY_ROW_PARTS 8u  // an update makes one row in so many anew
// Rays that a row remembers: at so many what it has learned is halved.
#define SKY_MOST_RAYS 8192u
// Words of a row that learns: rays that saw the sky, by bins; all rays; what those brought that met faces, in parts of
// what the sky brings on the average.
#define SKY_RAYS_AT SKY_BINS
#define SKY_FACES_AT (SKY_BINS + 1)
#define SKY_LEARNED_WORDS (SKY_BINS + 2)
#define SKY_FACE_PARTS 16
// Words of a row that guides: its share of rays as a float; slots, a byte each; the number of slots of each bin, a byte each.
#define SKY_SLOTS_AT 1
#define SKY_COUNTS_AT (SKY_SLOTS_AT + SKY_SLOTS / 4)
#define SKY_GUIDE_WORDS (SKY_COUNTS_AT + SKY_BINS / 4)
