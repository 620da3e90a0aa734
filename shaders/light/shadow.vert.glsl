#version 450 core
// SPDX-License-Identifier: MIT
// Vertices of the scene -> clip space of one shadow map (light/shadow_maps.cpp). MASKED: what the cut-off
// needs.
#ifndef MASKED
#error MASKED must be 0 or 1
#endif
#include "lib/scene_tables.glsl"

layout(location = 0) in vec3 position;
layout(location = 5) in uint instanceIndex;
#include "light/shadow_view.glsl"

#if MASKED
layout(location = 2) in vec2 uv;
layout(location = 4) in uint color;
layout(location = 0) out vec2 outUv;
layout(location = 1) out float outAlpha;
layout(location = 2) flat out uint outMaterial;
#endif

void main() {
    vec3 world = (instances[instanceIndex].worldFromObject * vec4(position, 1.0)).xyz;
    gl_Position = shadowMap.clipFromWorld * vec4(world, 1.0);
#if MASKED
    outUv = uv;
    outMaterial = instances[instanceIndex].material;
    outAlpha = materials[outMaterial].baseColor.a * vertexColor(color, instances[instanceIndex].flags).a;
#endif
}
