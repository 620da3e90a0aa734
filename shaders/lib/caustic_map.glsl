// SPDX-License-Identifier: MIT
// Light that solids of glass have gathered elsewhere (shared/caustics.h): a place -> its irradiance. Each solid
// stands for a lamp in its middle whose intensity, per direction, is that of the light that leaves it on any
// way, and which reaches as far as this light goes. Method: docs/theory/4h_glass.md, "Caustics".
// GLASS or CAUSTICS 0: the file is empty.
#include "lib/dot.glsl"
#include "lib/octahedral.glsl"
#include "shared/caustics.h"
#ifndef GLASS
#define GLASS 0
#endif
#ifndef CAUSTICS
#define CAUSTICS 0
#endif
#if GLASS || CAUSTICS
layout(std140) uniform CausticBlock { CausticConstants caustics; };
uniform sampler2DArray causticMap;

// Light counts where it ends: within the first of these shares of its way in front or behind, and not beyond
// the second. First guesses, looked at with a ball on a floor and a block before a wall; not tuned.
const vec2 kCausticReach = vec2(0.1, 0.2);
// The same, voxels: what paths meet are the voxels' plane pieces.
const float kCausticSlack = 1.5;

// The octahedron's pole looks down, so that its seams lie above.
vec2 causticPlace(vec3 direction) { return octEncode(vec3(direction.x, direction.z, -direction.y)); }

// Irradiance at a place whose surface looks towards `normal`, the mean over `width` m; 0: as fine as the map.
vec3 causticIrradiance(vec3 position, vec3 normal, float width) {
    vec3 irradiance = vec3(0.0);
    uint i = 0u;
    if (caustics.count > 0u) do {
            vec3 way = position - caustics.middle[i].xyz;
            float distance = max(length(way), 0.02 * caustics.middle[i].w);
            way /= distance;
            float level = max(log2(width / distance * 0.5 * caustics.edge), 0.0);
            vec4 light = textureLod(causticMap, vec3(0.5 * causticPlace(way) + 0.5, float(i)), level);
            float mean = light.a / max(light.r + light.g + light.b, 1e-30);
            vec2 reach = kCausticReach * mean + kCausticSlack * caustics.voxelSize;
            float ends = 1.0 - smoothstep(reach.x, reach.y, abs(distance - mean));
            irradiance += light.rgb * (ends * max(-dot(way, normal), 0.0) / (distance * distance));
        } while (++i < caustics.count);
    return irradiance;
}
#endif
