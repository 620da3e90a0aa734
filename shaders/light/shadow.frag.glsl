#version 450 core
// SPDX-License-Identifier: MIT
// Discards what a masked (or less than half opaque blended) material does not cover; as
// view/gbuffer.frag.glsl.
#include "lib/scene_tables.glsl"
#if !MASKED
#error only masked materials need this stage
#endif

layout(location = 0) in vec2 uv;
layout(location = 1) in float alpha;
layout(location = 2) flat in uint material;
layout(binding = UNIT_MATERIAL_BASE) uniform sampler2D baseTexture;

void main() {
    vec3 row0 = materials[material].uvRow[0].xyz;
    vec3 row1 = materials[material].uvRow[1].xyz;
    float a = alpha * texture(baseTexture, vec2(dot(row0.xy, uv) + row0.z, dot(row1.xy, uv) + row1.z)).a;
    float cutoff =
        (materials[material].flags & MATERIAL_ALPHA_MASK) != 0u ? materials[material].alphaCutoff : 0.5;
    if (a < cutoff) discard;
}
