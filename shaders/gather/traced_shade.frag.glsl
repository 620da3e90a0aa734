#version 450 core
// SPDX-License-Identifier: MIT
// The picture of mode `traced`: see gather/traced_shade.glsl. As fragments, not by a compute shader that
// stores an image: software drivers store images word by word, which took a quarter of the pass.
#define FLAT_CONSTANTS 1
#include "gather/traced_shade.glsl"
layout(location = 0) out vec4 result;

void main() { result = tracedShade(ivec2(gl_FragCoord.xy)); }
