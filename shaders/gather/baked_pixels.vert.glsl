#version 450 core
// SPDX-License-Identifier: MIT
// Vertices of baked light -> clip space, for baked_pixels.frag.glsl.
#include "lib/frame_block.glsl"

layout(location = 0) in vec3 position;  // world
layout(location = 1) in uint instance;
layout(location = 2) in vec3 irradiance;  // / pi

layout(location = 0) flat out uint outInstance;
layout(location = 1) out vec3 outIrradiance;

void main() {
    gl_Position = frame.clipFromWorld * vec4(position, 1.0);
    outInstance = instance;
    outIrradiance = irradiance;
}
