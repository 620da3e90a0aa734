#version 450 core
// SPDX-License-Identifier: MIT
// The picture of mode `traced` (gather/traced_shade.glsl) as fragments, for software drivers: those store images word by
// word, which took a quarter of the pass as a compute shader.
#define FLAT_CONSTANTS 1
#include "gather/traced_shade.glsl"
layout(location = 0) out vec4 result;

void main() { result = tracedShade(ivec2(gl_FragCoord.xy)); }
