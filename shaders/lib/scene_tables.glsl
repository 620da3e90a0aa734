// SPDX-License-Identifier: MIT
// Read access to the scene tables (shared/scene.h) for every shader that needs them.
#include "lib/flat_constants.glsl"
#include "lib/vertex_color.glsl"
#include "shared/bindings.h"
#include "shared/frame.h"
#include "shared/lighting.h"
#include "shared/scene.h"
#if !FLAT_CONSTANTS
layout(std140) uniform FrameBlock { FrameConstants frame; };
layout(std140) uniform LightingBlock { LightingConstants lighting; };
#endif
layout(std430) readonly buffer InstanceTable { Instance instances[]; };
layout(std430) readonly buffer MaterialTable { Material materials[]; };
layout(std430) readonly buffer LightTable { Light lights[]; };
