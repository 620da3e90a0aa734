// SPDX-License-Identifier: MIT
// Counts what an invocation looks up: texture fetches, image loads, gathers of four texels.
// COUNT_LOOKUPS 0: COUNT_LOOKUP is nothing. 1: it adds to lookupsMade, which main() hands to addLookups, kind
// by kind (LOOKUPS_* of shared/cones.h). The buffer's binding is LOOKUP_TABLE.
#ifndef COUNT_LOOKUPS
#define COUNT_LOOKUPS 0
#endif
#include "shared/lookups.h"
#if COUNT_LOOKUPS
layout(std430) buffer LookupTable { uint lookups[]; };
uint lookupsMade = 0u;
#define COUNT_LOOKUP(n) lookupsMade += uint(n)

// Adds what was counted since the last call, with a carry: a frame may look up more than 32 bits hold.
void addLookups(int kind, bool counts) {
    uint n = counts ? lookupsMade : 0u;
    uint before = atomicAdd(lookups[kind], n);
    if (before + n < before) atomicAdd(lookups[LOOKUPS_CARRY + kind], 1u);
    lookupsMade = 0u;
}
#else
#define COUNT_LOOKUP(n)
#endif
