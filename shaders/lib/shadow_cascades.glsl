// SPDX-License-Identifier: MIT
// Visibility of directional lights at pixels, by maps about the eye (view/shadow_cascades.h): position and normal ->
// [0,1]. docs/theory/3_light.md, "From a metre to kilometres".
//
// Level k serves what is within so many metres of the eye, across the light's direction; each next one of twice as
// many, or 4 times, and the last the whole scene. Which level serves a point depends on the distance alone, and each
// level's texels stay where they are in the world. With a filter, whose width in metres is another on each level, they
// pass over into each other.
#include "lib/dot.glsl"
#include "lib/shadow.glsl"
#include "shared/shadow_cascades.h"
layout(std430) readonly buffer CascadeTable {
    CascadeConstants constants;
    Cascade cascades[];
}
cascadeTable;
uniform sampler2DArray cascadeDepths;
uniform usampler2DArray cascadeSurfaces;

#if SHADOW_DIVIDED
float cascadeTexel = 0.0;  // of the last lookup, m
#endif

const float kCascadeBlend =
    0.75;  // from there on of a level's reach filtered shadows pass over into the next's

float cascadeVisibility(Light light, uint at, vec3 p, vec3 n) {
    Cascade map = cascadeTable.cascades[at];
#if SHADOW_DIVIDED
    cascadeTexel = map.texel;
#endif
    return shadowVisibilityParallel(
        cascadeDepths, cascadeSurfaces, light,
        ParallelShadow(map.position, map.shadowNear, map.texel, map.layer, vec2(0.0)), p, n);
}

// Visibility of the directional light that is `number` in its kind.
float shadowVisibilityCascaded(Light light, uint number, vec3 p, vec3 n) {
    CascadeConstants c = cascadeTable.constants;
    vec3 fromMiddle = p - c.middle;
    float away = max(max(abs(dot(fromMiddle, light.halfU)), abs(dot(fromMiddle, light.halfV))),
                     abs(dot(fromMiddle, light.direction)) * c.inverseDepth);
    float wanted = log2(max(away, 1e-20) * c.inverseNearest) * c.perDoubling;
    float last = float(c.levels - 1u);
    float level = clamp(ceil(wanted), 0.0, last);
    uint first = number * c.levels;
    float lit = cascadeVisibility(light, first + uint(level), p, n);
#if SHADOW_FILTER > 0
    float farther = cascadeVisibility(light, first + uint(min(level + 1.0, last)), p, n);
    lit = mix(lit, farther, smoothstep(kCascadeBlend, 1.0, exp2((wanted - level) / c.perDoubling)));
#endif
    return lit;
}
