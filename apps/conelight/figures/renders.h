// SPDX-License-Identifier: MIT
// Figures that are pictures of scenes, and the tables that are measured.
#pragma once

#include "figures/studio.h"

namespace conelight::figures {

using Panels = std::vector<Panel>;

}  // namespace conelight::figures
