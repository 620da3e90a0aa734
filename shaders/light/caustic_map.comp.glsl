#version 450 core
// SPDX-License-Identifier: MIT
// The map of one solid from its sums, from the coarsest level to the finest: whole numbers of light per texel, and
// what the level above holds between its texels. Levels keep their totals as floats in place of the numbers; the finest
// one becomes the map: W/sr, and the same times the distance (shared/caustics.h). One invocation per texel.
layout(local_size_x = 8, local_size_y = 8) in;
#include "lib/caustic_levels.glsl"
#include "lib/dot.glsl"
#include "lib/octahedral.glsl"
layout(std140) uniform CausticPassBlock { CausticPass causticPass; };
layout(std430) buffer CausticSums { uint sums[]; };
layout(rgba32f) writeonly uniform image2DArray causticLayers;

float channelOf(uint word, uint channel) {
    return float(sums[word + 2u * channel]) + 4294967296.0 * float(sums[word + 2u * channel + 1u]);
}

vec4 totalOf(uint level, uvec2 texel) {
    uint word = causticWord(causticPass.edge, level, texel);
    return uintBitsToFloat(uvec4(sums[word], sums[word + 1u], sums[word + 2u], sums[word + 3u]));
}

// What the coarser level has for this texel: a quarter, between the four texels about its centre.
vec4 coarserAt(uvec2 at, uint level) {
    uint last = (causticPass.edge >> level) - 1u;
    vec2 place = clamp(0.5 * (vec2(at) + 0.5) - 0.5, vec2(0.0), vec2(last));
    uvec2 a = uvec2(place), b = min(a + 1u, uvec2(last));
    vec2 part = place - vec2(a);
    vec4 lower = mix(totalOf(level, a), totalOf(level, uvec2(b.x, a.y)), part.x);
    vec4 upper = mix(totalOf(level, uvec2(a.x, b.y)), totalOf(level, b), part.x);
    return 0.25 * mix(lower, upper, part.y);
}

// 1 / the solid angle of a texel: the octahedron's face is 1 / sqrt(3) away, and seen at its cosine.
float perSteradian(uvec2 at) {
    float edge = float(causticPass.edge);
    vec2 place = 2.0 * (vec2(at) + 0.5) / edge - 1.0;
    vec3 n = vec3(place, 1.0 - abs(place.x) - abs(place.y));
    if (n.z < 0.0) n.xy = octWrap(n.xy);
    return pow(dot(n, n), 1.5) * edge * edge / 4.0;
}

void main() {
    uvec2 at = gl_GlobalInvocationID.xy;
    uint level = causticPass.level, edge = causticPass.edge >> level;
    if (at.x >= edge || at.y >= edge) return;
    uint word = causticWord(causticPass.edge, level, at);
    vec4 light = vec4(channelOf(word, 0u), channelOf(word, 1u), channelOf(word, 2u), channelOf(word, 3u));
    if (level + 1u < CAUSTIC_LEVELS) light += coarserAt(at, level + 1u);
    if (level > 0u) {
        uvec4 bits = floatBitsToUint(light);
        for (uint channel = 0u; channel < 4u; ++channel) sums[word + channel] = bits[channel];
        return;
    }
    imageStore(causticLayers, ivec3(at, causticPass.solid), light * (perSteradian(at) / causticPass.scale));
}
