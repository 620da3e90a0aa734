// SPDX-License-Identifier: MIT
// Instances and materials (shared/scene.h).
#include "lib/vertex_color.glsl"
#include "shared/scene.h"
layout(std430) readonly buffer InstanceTable { Instance instances[]; };
layout(std430) readonly buffer MaterialTable { Material materials[]; };
