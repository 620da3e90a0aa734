// SPDX-License-Identifier: MIT
// Where the levels of the sums of light lie (shared/caustics.h).
#include "shared/caustics.h"

uint causticLevelEdge(uint edge, uint level) { return edge >> level; }

// The first texel of a level: of `level` squares, each a quarter of the one before.
uint causticLevelStart(uint edge, uint level) {
    uint start = 0u;
    for (uint i = 0u; i < level; ++i) start += (edge >> i) * (edge >> i);
    return start;
}

// The word of a texel's first channel.
uint causticWord(uint edge, uint level, uvec2 texel) {
    return CAUSTIC_WORDS *
           (causticLevelStart(edge, level) + texel.y * causticLevelEdge(edge, level) + texel.x);
}
