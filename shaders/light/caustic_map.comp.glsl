#version 450 core
// SPDX-License-Identifier: MIT
// The map of one solid from its sums: whole numbers of light per texel -> W/sr, and the same times the distance
// (shared/caustics.h). One invocation per texel.
layout(local_size_x = 8, local_size_y = 8) in;
#include "lib/dot.glsl"
#include "shared/caustics.h"
layout(std140) uniform CausticPassBlock { CausticPass causticPass; };
layout(std430) readonly buffer CausticSums { uint sums[]; };
layout(rgba32f) writeonly uniform image2DArray causticLayers;

float channelOf(uint texel, uint channel) {
    uint word = CAUSTIC_WORDS * texel + 2u * channel;
    return float(sums[word]) + 4294967296.0 * float(sums[word + 1u]);
}

void main() {
    uvec2 at = gl_GlobalInvocationID.xy;
    if (at.x >= causticPass.edge || at.y >= causticPass.edge) return;
    uint texel = at.y * causticPass.edge + at.x;
    // Solid angle of the texel: the octahedron's face is 1 / sqrt(3) away, and seen at its cosine.
    vec2 place = 2.0 * (vec2(at) + 0.5) / float(causticPass.edge) - 1.0;
    vec3 n = vec3(place, 1.0 - abs(place.x) - abs(place.y));
    if (n.z < 0.0) n.xy = (1.0 - abs(n.yx)) * vec2(n.x >= 0.0 ? 1.0 : -1.0, n.y >= 0.0 ? 1.0 : -1.0);
    float perSteradian =
        pow(dot(n, n), 1.5) * float(causticPass.edge * causticPass.edge) / (4.0 * causticPass.scale);
    vec4 light = vec4(channelOf(texel, 0u), channelOf(texel, 1u), channelOf(texel, 2u), channelOf(texel, 3u));
    imageStore(causticLayers, ivec3(at, causticPass.solid), light * perSteradian);
}
