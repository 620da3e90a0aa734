// SPDX-License-Identifier: MIT
// Open Image Denoise for denoise.h, where the build has it.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "reference/denoise_filter.h"

namespace conelight::reference {

// Filters radiance in place. Throws Error(Usage) where it is not built in, Error(Runtime) when it fails.
void filterByOidn(std::vector<glm::vec3>& color, const GuideTable& guide);

}  // namespace conelight::reference
