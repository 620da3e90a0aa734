// SPDX-License-Identifier: MIT
// Which probes of a grid surfaces need: those that a lookup at a surface reads.
#pragma once

#include <vector>

#include "reference/probes.h"

namespace conelight::reference {

// By probe: whether a triangle of a visible instance lies in its cell or in one beside it.
std::vector<bool> probesNearSurfaces(const Scene& scene, const ProbeGrid& grid);

}  // namespace conelight::reference
