#version 450 core
// SPDX-License-Identifier: MIT
// The ranges that an update of all faces visits, where the CPU does not know how many there are (light/irradiance_cache.h):
// faces that gather before, in and behind the part in which rays look for faces inside closed objects, then those that
// may be inside of one.
layout(local_size_x = 8) in;
#include "shared/irradiance.h"
layout(std140) uniform RangeBlock { CacheRanges cut; };
layout(std430) readonly buffer OrderCounts {
    uint gathering;
    uint doubtful;
};
layout(std430) writeonly buffer RangeTable { uint ranges[]; };

void main() {
    uint range = gl_LocalInvocationIndex;
    if (range >= CACHE_RANGES) return;
    uint starts[] = uint[](0u, cut.part * gathering / cut.parts, (cut.part + 1u) * gathering / cut.parts,
                           gathering, gathering + doubtful);
    uint count = starts[range + 1u] - starts[range];
    uint groups = (count + 63u) / 64u;
    uint at = CACHE_RANGE_WORDS * range;
    ranges[at] = starts[range];
    ranges[at + 1u] = count;
    ranges[at + 2u] = min(groups, 32768u);
    ranges[at + 3u] = (groups + 32767u) / 32768u;
    ranges[at + 4u] = 1u;
}
