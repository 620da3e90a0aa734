#version 450 core
// SPDX-License-Identifier: MIT
// What the picture of mode `traced` shows at one pixel, for the inspector (RECORD_STEPS): see
// gather/traced_shade.glsl.
#ifndef RECORD_STEPS
#error pictures are drawn by gather/traced_shade.frag.glsl
#endif
#include "gather/traced_shade.glsl"
layout(local_size_x = 8, local_size_y = 8) in;

void main() { tracedShade(min(INVOCATION_PIXEL, textureSize(gbufferGeometry, 0) - 1)); }
