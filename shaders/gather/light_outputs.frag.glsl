#version 450 core
// SPDX-License-Identifier: MIT
// Light for a host's own shading (gather/light_outputs.glsl) as fragments, for software drivers.
#include "gather/light_outputs.glsl"
layout(location = 0) out vec4 outDiffuse;
layout(location = 1) out vec4 outSpecular;

void main() { lightOutputs(ivec2(gl_FragCoord.xy), outDiffuse, outSpecular); }
