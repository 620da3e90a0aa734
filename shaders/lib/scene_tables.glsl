// SPDX-License-Identifier: MIT
// Read access to the scene tables (shared/scene.h) for every shader that needs them.
#include "shared/bindings.h"
#include "shared/frame.h"
#include "shared/scene.h"
layout(std140, binding = BINDING_FRAME) uniform FrameBlock { FrameConstants frame; };
layout(std430, binding = BINDING_INSTANCES) readonly buffer InstanceTable { Instance instances[]; };
layout(std430, binding = BINDING_MATERIALS) readonly buffer MaterialTable { Material materials[]; };
layout(std430, binding = BINDING_LIGHTS) readonly buffer LightTable { Light lights[]; };

// Vertex::color as r, g, b, opacity. Wide colours: 9 bits each of one exponent (EXT_texture_shared_exponent),
// opaque.
vec4 vertexColor(uint bits, uint instanceFlags) {
    if ((instanceFlags & INSTANCE_WIDE_COLORS) == 0u) return unpackUnorm4x8(bits);
    vec3 mantissa = vec3(bits & 511u, (bits >> 9) & 511u, (bits >> 18) & 511u);
    return vec4(mantissa * exp2(float(bits >> 27) - 24.0), 1.0);
}
