// SPDX-License-Identifier: MIT
// The second pass of a prefix sum (shared/prefix_sum.h), by one group of PREFIX_GROUP invocations. Sums have an order:
// fractions are the same in every run. Includers define PREFIX_TYPE, a type of numbers, and declare `chunks`, a list of
// them. PREFIX_CHUNKS 0: sums of invocations alone, without that list. PREFIX_LANES: invocations, if others.
#include "shared/prefix_sum.h"
#ifndef PREFIX_CHUNKS
#define PREFIX_CHUNKS 1
#endif
#ifndef PREFIX_LANES
#define PREFIX_LANES PREFIX_GROUP
#endif
#ifndef PREFIX_TYPE
#error PREFIX_TYPE must be a type of numbers
#endif

shared PREFIX_TYPE sums[PREFIX_LANES];

// The sum of this invocation's elements -> the sum of all before them, and of all. Every invocation calls it, once.
PREFIX_TYPE prefixBefore(PREFIX_TYPE sum, out PREFIX_TYPE total) {
    uint index = gl_LocalInvocationIndex;
    sums[index] = sum;
    barrier();
    for (uint reach = 1u; reach < uint(PREFIX_LANES); reach *= 2u) {
        PREFIX_TYPE before = sums[index - min(reach, index)];
        barrier();
        if (index >= reach) sums[index] += before;
        barrier();
    }
    total = sums[PREFIX_LANES - 1];
    PREFIX_TYPE before = sums[index - min(1u, index)];
    return index > 0u ? before : PREFIX_TYPE(0);
}

#if PREFIX_CHUNKS
// The sums of `count` chunks -> what is before each; returns the sum of all.
PREFIX_TYPE prefixChunks(uint count) {
    uint each = (count + uint(PREFIX_LANES) - 1u) / uint(PREFIX_LANES);
    uint first = min(gl_LocalInvocationIndex * each, count);
    uint end = min(first + each, count);
    PREFIX_TYPE sum = PREFIX_TYPE(0);
    for (uint i = first; i < end; ++i) sum += chunks[i];
    PREFIX_TYPE total;
    PREFIX_TYPE before = prefixBefore(sum, total);
    for (uint i = first; i < end; ++i) {
        PREFIX_TYPE own = chunks[i];
        chunks[i] = before;
        before += own;
    }
    return total;
}
#endif
