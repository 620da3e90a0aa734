// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

namespace conelight::light {

// Firefly clamp: the largest ratio of what a ray brings by reflections on metal to what the metal shows if
// diffuse, for a mean of so many rays. A single ray then moves the mean by no more than the diffuse metal
// would. At least 8, by eye: with less, lamps seen in two metals vanish from quality draft.
inline float fireflyClamp(int rays) { return static_cast<float>(std::max(rays, 8)); }

}  // namespace conelight::light
