// SPDX-License-Identifier: MIT
#include "modes/memory_stats.h"

#include <algorithm>

#include "gl/object.h"

namespace conelight::modes {

std::vector<MemoryStats> memoryStats(std::uint32_t owner) {
    std::vector<MemoryStats> memory;
    for (const gl::LiveObject& object : gl::liveObjects())
        if (object.owner == owner && object.bytes > 0) memory.push_back({object.label, object.bytes});
    std::stable_sort(memory.begin(), memory.end(),
                     [](const MemoryStats& a, const MemoryStats& b) { return a.bytes > b.bytes; });
    return memory;
}

}  // namespace conelight::modes
