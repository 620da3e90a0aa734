// SPDX-License-Identifier: MIT
// Values of the octree of radiance, filtered or texel by texel (shared/radiance_octree.h).
#include "lib/radiance_octree.glsl"
uniform sampler3D radianceBricks;

// What a node's brick for a direction holds at a place of octreePlace, filtered; zero without a brick.
vec4 octreeSample(uvec2 record, int block, vec3 place) {
    return octreeFiltered(radianceBricks, record, block, place);
}

// One texel of a level.
vec4 octreeTexel(ivec3 texel, int level, int block) {
    return octreeFetched(radianceBricks, texel, level, block);
}
