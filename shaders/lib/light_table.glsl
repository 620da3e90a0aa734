// SPDX-License-Identifier: MIT
// The light table (shared/scene.h), sorted by kind.
#include "lib/lighting.glsl"
#include "shared/scene.h"
layout(std430) readonly buffer LightTable { Light lights[]; };
