// SPDX-License-Identifier: MIT
// The second pass of a prefix sum (shared/prefix_sum.h), for numbers of PREFIX_TYPE. Sums have an order: fractions are
// the same in every run.
#include "shared/prefix_sum.h"
#ifndef PREFIX_TYPE
#error PREFIX_TYPE must be a type of numbers
#endif
layout(local_size_x = PREFIX_GROUP) in;

shared PREFIX_TYPE sums[PREFIX_GROUP];

// The elements of `count` that this invocation adds up: from x, to before y.
uvec2 prefixRange(uint count) {
    uint each = (count + uint(PREFIX_GROUP) - 1u) / uint(PREFIX_GROUP);
    uint first = min(gl_LocalInvocationIndex * each, count);
    return uvec2(first, min(first + each, count));
}

// The sum of this invocation's elements -> the sum of all before them, and of all. Every invocation calls it, once.
PREFIX_TYPE prefixBefore(PREFIX_TYPE sum, out PREFIX_TYPE total) {
    uint index = gl_LocalInvocationIndex;
    sums[index] = sum;
    barrier();
    for (uint reach = 1u; reach < uint(PREFIX_GROUP); reach *= 2u) {
        PREFIX_TYPE before = sums[index - min(reach, index)];
        barrier();
        if (index >= reach) sums[index] += before;
        barrier();
    }
    total = sums[PREFIX_GROUP - 1];
    PREFIX_TYPE before = sums[index - min(1u, index)];
    return index > 0u ? before : PREFIX_TYPE(0);
}
