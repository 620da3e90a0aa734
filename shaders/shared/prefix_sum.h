// SPDX-License-Identifier: MIT
// Prefix sums in three passes: one invocation adds up a chunk of consecutive elements; one group turns the chunks' sums
// into what is before each (lib/prefix_sum.glsl); one invocation per chunk counts on from there. In none does an
// invocation walk over more than 64, up to two million elements.
#pragma once

#define PREFIX_GROUP 512           // invocations of the second pass
#define PREFIX_MOST_CHUNKS 32768u  // 64 for each
#define PREFIX_LEAST_CHUNK 16u     // fewer elements are not worth starting an invocation

#ifdef __cplusplus
#include <algorithm>
#include <cstdint>

namespace conelight::gpu {
// Elements of a chunk, of so many in all.
constexpr std::uint32_t perChunk(std::uint32_t count) {
    return std::max((count + PREFIX_MOST_CHUNKS - 1) / PREFIX_MOST_CHUNKS, PREFIX_LEAST_CHUNK);
}
constexpr std::uint32_t chunksOf(std::uint32_t count) {
    return (count + perChunk(count) - 1) / perChunk(count);
}
// The most that so many elements, or fewer, are cut into.
constexpr std::uint32_t mostChunks(std::uint32_t count) {
    return std::min((count + PREFIX_LEAST_CHUNK - 1) / PREFIX_LEAST_CHUNK, PREFIX_MOST_CHUNKS);
}
}  // namespace conelight::gpu
#endif
