// SPDX-License-Identifier: MIT
// Where a texel of the sums of light lies (shared/caustics.h): the word of its first channel.
#include "shared/caustics.h"

uint causticWord(uint edge, uint level, uvec2 texel) {
    return CAUSTIC_WORDS * (CAUSTIC_LEVEL_START(edge, level) + texel.y * (edge >> level) + texel.x);
}
