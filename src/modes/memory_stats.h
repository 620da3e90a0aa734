// SPDX-License-Identifier: MIT
// The memory of one Renderer or LightField, of many in a process: what was made while its calls ran.
#pragma once

#include <cstdint>
#include <vector>

#include "conelight/renderer.h"

namespace conelight::modes {

// Live GL objects of `owner` (gl::OwnerScope) that have storage, largest first.
std::vector<MemoryStats> memoryStats(std::uint32_t owner);

}  // namespace conelight::modes
