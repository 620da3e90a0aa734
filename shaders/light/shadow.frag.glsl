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
    // Gradients of the interpolated uv: see view/gbuffer.frag.glsl.
    mat2 turn = mat2(row0.x, row1.x, row0.y, row1.y);
    float a = alpha *
              textureGrad(baseTexture, turn * uv + vec2(row0.z, row1.z), turn * dFdx(uv), turn * dFdy(uv)).a;
    float cutoff =
        (materials[material].flags & MATERIAL_ALPHA_MASK) != 0u ? materials[material].alphaCutoff : 0.5;
    if (a < cutoff) discard;
}
