// SPDX-License-Identifier: MIT
// Sky and numbers of lights, as `lighting`.
#include "lib/flat_constants.glsl"
#include "shared/lighting.h"
#if !FLAT_CONSTANTS
layout(std140) uniform LightingBlock { LightingConstants lighting; };
#endif
