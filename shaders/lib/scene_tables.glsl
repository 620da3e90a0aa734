// SPDX-License-Identifier: MIT
// Read access to the scene tables (shared/scene.h) for every shader that needs them.
#include "lib/vertex_color.glsl"
#include "shared/bindings.h"
#include "shared/frame.h"
#include "shared/scene.h"
layout(std140, binding = BINDING_FRAME) uniform FrameBlock { FrameConstants frame; };
layout(std430, binding = BINDING_INSTANCES) readonly buffer InstanceTable { Instance instances[]; };
layout(std430, binding = BINDING_MATERIALS) readonly buffer MaterialTable { Material materials[]; };
layout(std430, binding = BINDING_LIGHTS) readonly buffer LightTable { Light lights[]; };
