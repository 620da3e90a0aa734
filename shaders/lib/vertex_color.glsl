// SPDX-License-Identifier: MIT
// Vertex::color as r, g, b, opacity. Wide colours: 9 bits each of one exponent (EXT_texture_shared_exponent),
// opaque.
#include "shared/scene.h"

vec4 vertexColor(uint bits, uint instanceFlags) {
    if ((instanceFlags & INSTANCE_WIDE_COLORS) == 0u) return unpackUnorm4x8(bits);
    vec3 mantissa = vec3(bits & 511u, (bits >> 9) & 511u, (bits >> 18) & 511u);
    return vec4(mantissa * exp2(float(bits >> 27) - 24.0), 1.0);
}
