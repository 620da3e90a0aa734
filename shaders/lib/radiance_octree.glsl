// SPDX-License-Identifier: MIT
// Look-ups in the octree of radiance (shared/radiance_octree.h): place and level -> what the dense volume has
// there. Each goes down from the root.
#include "shared/radiance_octree.h"
layout(std140) uniform RadianceOctreeBlock { RadianceOctree octree; };
layout(std430) readonly buffer OctreeNodes { uvec2 octreeNodes[]; };

// From a node's record to that of the child on the way to `node`, which lies `below` levels deeper; zero where
// there is none.
void octreeDescend(inout uvec2 at, inout int below, ivec3 node) {
    if (below == 0) return;
    --below;
    ivec3 side = (node >> below) & 1;
    int child = side.x | (side.y << 1) | (side.z << 2);
    uint children = at.x >> OCTREE_CHILDREN_SHIFT;
    uint number = (at.x & OCTREE_CHILD_MASK) + uint(bitCount(children & ((1u << child) - 1u)));
    at = ((children >> child) & 1u) != 0u ? octreeNodes[number] : uvec2(0u);
}

// Record of node `node` of `level`; zero where there is none. Not a loop: cones would reach the number of
// turns, over all loops, at which llvmpipe ends them without a word. OCTREE_DEEPEST steps.
uvec2 octreeNode(ivec3 node, int level) {
    int start = max(level, int(octree.rootLevel));
    int below = start - level;
    // Outside of the root there is nothing.
    uvec2 at = (node >> below) == ivec3(0) ? octreeNodes[int(octree.topLevel) - start] : uvec2(0u);
    octreeDescend(at, below, node);
    octreeDescend(at, below, node);
    octreeDescend(at, below, node);
    octreeDescend(at, below, node);
    octreeDescend(at, below, node);
    octreeDescend(at, below, node);
    octreeDescend(at, below, node);
    octreeDescend(at, below, node);
    return at;
}

// First texel of a brick.
ivec3 octreeCorner(uint brick) {
    uint row = (1u << octree.rowBits) - 1u;
    return OCTREE_BRICK_EDGE *
           ivec3(brick & row, (brick >> octree.rowBits) & row, brick >> (2u * octree.rowBits));
}
// Whether a node has a brick for a direction (block), and the brick's first texel.
bool octreeHas(uvec2 record, int block) {
    return ((record.y >> (OCTREE_DIRECTION_SHIFT + block)) & 1u) != 0u;
}
ivec3 octreeCornerOf(uvec2 record, int block) {
    uint before = (record.y >> OCTREE_DIRECTION_SHIFT) & ((1u << block) - 1u);
    return octreeCorner((record.y & OCTREE_NUMBER_MASK) + uint(bitCount(before)));
}

// Where a level of `size` texels is sampled at q (0..1 in the volume; clamped to the edge, as textures are):
// the node's record, and the place in its bricks, in texels.
uvec2 octreePlace(vec3 q, ivec3 size, int level, out vec3 place) {
    vec3 u = clamp(q * vec3(size) - 0.5, vec3(0.0), vec3(size - 1));
    ivec3 node = ivec3(u) >> OCTREE_NODE_BITS;
    place = u - vec3(node << OCTREE_NODE_BITS) + 0.5;
    return octreeNode(node, level);
}

// What a node's brick for a direction holds there, filtered; zero without a brick. `bricks`: a texture of the
// tree's bricks.
vec4 octreeFiltered(sampler3D bricks, uvec2 record, int block, vec3 place) {
    if (!octreeHas(record, block)) return vec4(0.0);
    vec3 texel = vec3(octreeCornerOf(record, block)) + place;
    return textureLod(bricks, texel * octree.inverseTextureSize, 0.0);
}

// One texel of a level.
vec4 octreeFetched(sampler3D bricks, ivec3 texel, int level, int block) {
    uvec2 record = octreeNode(texel >> OCTREE_NODE_BITS, level);
    if (!octreeHas(record, block)) return vec4(0.0);
    return texelFetch(bricks, octreeCornerOf(record, block) + (texel & (OCTREE_NODE_EDGE - 1)), 0);
}

// ---- Slots.

// Number of slots in the levels above `level`.
uint octreeFirstSlot(int level) {
    int below = max(int(octree.rootLevel) - level, 0);
    return octree.topLevel - uint(max(level, int(octree.rootLevel))) + ((1u << (3 * below)) - 1u) / 7u;
}

// Spreads 10 bits to every third; inverse.
uint octreeSpread(int coordinate) {
    uint x = uint(coordinate);
    x = (x | (x << 16)) & 0x030000ffu;
    x = (x | (x << 8)) & 0x0300f00fu;
    x = (x | (x << 4)) & 0x030c30c3u;
    return (x | (x << 2)) & 0x09249249u;
}
int octreeGather(uint x) {
    x &= 0x09249249u;
    x = (x | (x >> 2)) & 0x030c30c3u;
    x = (x | (x >> 4)) & 0x0300f00fu;
    x = (x | (x >> 8)) & 0x030000ffu;
    return int((x | (x >> 16)) & 0x3ffu);
}
uint octreeSlot(ivec3 node, int level) {
    return octreeFirstSlot(level) +
           (octreeSpread(node.x) | (octreeSpread(node.y) << 1) | (octreeSpread(node.z) << 2));
}
ivec3 octreeNodeOfSlot(uint slot, int level) {
    uint morton = slot - octreeFirstSlot(level);
    return ivec3(octreeGather(morton), octreeGather(morton >> 1), octreeGather(morton >> 2));
}

// ---- Nodes that hold a texel: its own, and along axes on which it is the first of its own, the node before.

// Those axes, as bits.
int octreeBorders(ivec3 texel) {
    ivec3 first = ivec3(equal(texel & (OCTREE_NODE_EDGE - 1), ivec3(0))) *
                  ivec3(greaterThan(texel, ivec3(OCTREE_NODE_EDGE - 1)));
    return first.x | (first.y << 1) | (first.z << 2);
}
// One of the nodes, by a part of these bits: the node before along those axes. Parts are counted down from all
// of them to none; then comes -1.
ivec3 octreeHolder(ivec3 texel, int axes) {
    return (texel >> OCTREE_NODE_BITS) - (ivec3(axes, axes >> 1, axes >> 2) & 1);
}
int octreeNextAxes(int axes, int borders) { return axes == 0 ? -1 : (axes - 1) & borders; }
