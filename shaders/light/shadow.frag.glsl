#version 450 core
// SPDX-License-Identifier: MIT
// SURFACES: writes what lib/shadow.glsl needs to know of the triangle besides its depth: how fast that
// changes from texel to texel (r, two halves), and where the triangle ends towards the four next texels (g).
// MASKED: discards what a masked (or less than half opaque blended) material does not cover; as
// view/gbuffer.frag.glsl.
#if !MASKED && !SURFACES
#error depth alone of a closed surface needs no fragment stage
#endif
#include "lib/dot.glsl"
#include "lib/scene_tables.glsl"

#if SURFACES
layout(location = 3) flat in vec3 edge[3];
layout(location = 6) flat in vec4 viewConstants;
layout(location = 0) out uvec2 surface;

const float kShadowEnd = 2.0;  // lib/shadow.glsl
#endif
#if MASKED
layout(location = 0) in vec2 uv;
layout(location = 1) in float alpha;
layout(location = 2) flat in uint material;
uniform sampler2D baseTexture;
#endif

void main() {
#if SURFACES
    // Depth is a plane over the map for either projection, so differences within a quad are exact.
    vec2 slope = vec2(dFdx(gl_FragCoord.z), dFdy(gl_FragCoord.z));
    slope /= viewConstants.x + viewConstants.y * gl_FragCoord.z;

    // Where the triangle ends towards +x, -x, +y, -y, in texels.
    vec4 ends = vec4(kShadowEnd);
    for (int i = 0; i < 3; ++i) {
        float inside = max(dot(edge[i], vec3(gl_FragCoord.xy - viewConstants.zw, 1.0)), 0.0);
        vec2 t = inside / max(abs(edge[i].xy), 1e-20);
        bvec2 forward = lessThan(edge[i].xy, vec2(0.0));
        ends = min(ends, vec4(forward.x ? t.x : kShadowEnd, forward.x ? kShadowEnd : t.x,
                              forward.y ? t.y : kShadowEnd, forward.y ? kShadowEnd : t.y));
    }
    surface = uvec2(packHalf2x16(clamp(slope, -6e4, 6e4)), packUnorm4x8(ends / kShadowEnd));
#endif
#if MASKED
    vec3 row0 = materials[material].uvRow[0].xyz;
    vec3 row1 = materials[material].uvRow[1].xyz;
    // Gradients of the interpolated uv: see view/gbuffer.frag.glsl.
    mat2 turn = mat2(row0.x, row1.x, row0.y, row1.y);
    float a0 = alpha *
               textureGrad(baseTexture, turn * uv + vec2(row0.z, row1.z), turn * dFdx(uv), turn * dFdy(uv)).a;
    float cutoff =
        (materials[material].flags & MATERIAL_ALPHA_MASK) != 0u ? materials[material].alphaCutoff : 0.5;
    if (a0 < cutoff) discard;
#endif
}
