// SPDX-License-Identifier: MIT
// Values of the octree of radiance, filtered or texel by texel (shared/radiance_octree.h).
#include "lib/radiance_octree.glsl"
uniform sampler3D radianceBricks;

// Where a level of `size` texels is sampled at q (0..1 in the volume; clamped to the edge, as textures are):
// the node's record, and the place in its bricks, in texels.
uvec2 octreePlace(vec3 q, ivec3 size, int level, out vec3 place) {
    vec3 u = clamp(q * vec3(size) - 0.5, vec3(0.0), vec3(size - 1));
    ivec3 node = ivec3(u) >> OCTREE_NODE_BITS;
    place = u - vec3(node << OCTREE_NODE_BITS) + 0.5;
    return octreeNode(node, level);
}

// What a node's brick for a direction holds there, filtered; zero without a brick.
vec4 octreeSample(uvec2 record, int block, vec3 place) {
    if (!octreeHas(record, block)) return vec4(0.0);
    vec3 texel = vec3(octreeCornerOf(record, block)) + place;
    return textureLod(radianceBricks, texel * octree.inverseTextureSize, 0.0);
}

// One texel of a level.
vec4 octreeTexel(ivec3 texel, int level, int block) {
    uvec2 record = octreeNode(texel >> OCTREE_NODE_BITS, level);
    if (!octreeHas(record, block)) return vec4(0.0);
    return texelFetch(radianceBricks, octreeCornerOf(record, block) + (texel & (OCTREE_NODE_EDGE - 1)), 0);
}
