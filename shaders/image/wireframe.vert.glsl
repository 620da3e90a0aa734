#version 450 core
// SPDX-License-Identifier: MIT
// Vertices of the scene -> clip space, as the G-buffer has them, for the edges of triangles.
#include "lib/frame_block.glsl"
#include "lib/scene_tables.glsl"

layout(location = 0) in vec3 position;
layout(location = 5) in uint instanceIndex;

void main() {
    vec3 world = (instances[instanceIndex].worldFromObject * vec4(position, 1.0)).xyz;
    gl_Position = frame.clipFromWorld * vec4(world, 1.0);
}
