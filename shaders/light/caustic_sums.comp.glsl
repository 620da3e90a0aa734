#version 450 core
// SPDX-License-Identifier: MIT
// Adds up where paths of light have ended: CausticEnds -> sums of light over the octahedron of directions from the
// solid's middle. A path stands for all between it and its neighbours: it is spread over what they span, by
// their differences in the four numbers of its start (ray differentials: Igehy 1999, "Tracing Ray
// Differentials"). One invocation per path. Sums are of whole numbers, in two words: the same in any order.
layout(local_size_x = 64) in;
#include "lib/caustic_levels.glsl"
#include "lib/dot.glsl"
#include "lib/linear_index.glsl"
#include "lib/octahedral.glsl"
#include "lib/random.glsl"
layout(std140) uniform CausticPassBlock { CausticPass causticPass; };
layout(std430) readonly buffer CausticEnds { CausticEnd ends[]; };
layout(std430) buffer CausticSums { uint sums[]; };

// Neighbours farther apart than this on the octahedron, or where normals differ by more than this cosine, went
// through other parts of the solid. First guesses, looked at with a ball and a block; not tuned.
const float kApart = 0.25;
const float kEntryCosine = 0.8;
const float kQuarterTurn = 1.5707963;  // rad
// A path that covers more than this many texels goes to a coarser level. There it covers less than twice as many.
const float kTexelsOfLevel = 4.0;
// It spreads to about one place per texel that it covers, and so many at most.
const uint kMostPlaces = 16u;

vec3 entryOf(CausticEnd end) { return octDecode(unpackSnorm2x16(end.entry)); }

// What lies between a path and its neighbour along one of the four numbers of its start: the difference of
// places (xy) and distances. `step`: to the neighbour; 0, 0 for none at either side.
vec3 spanTo(CausticEnd self, uint index, uint at, uint count, uint step) {
    vec3 span = vec3(0.0);
    float found = 0.0;
    for (int side = 0; side < 2; ++side) {
        bool ahead = side == 0;
        bool there = ahead ? at + 1u < count : at > 0u;
        CausticEnd other = ends[there ? (ahead ? index + step : index - step) : index];
        vec3 between = vec3(other.place - self.place, other.distance - self.distance);
        bool near = there && other.history == self.history && length(between.xy) < kApart &&
                    dot(entryOf(other), entryOf(self)) > kEntryCosine;
        span += near ? (ahead ? between : -between) : vec3(0.0);
        found += near ? 1.0 : 0.0;
    }
    return span / max(found, 1.0);
}

void addTo(uint word, uint count) {
    uint before = atomicAdd(sums[word], count);
    if (before + count < before) atomicAdd(sums[word + 1u], 1u);
}

// Light at a place, shared by the four texels of a level about it.
void addLight(vec2 place, vec3 flux, float distance, uint level) {
    float edge = float(causticPass.edge >> level);
    vec2 at = clamp((0.5 * place + 0.5) * edge - 0.5, vec2(0.0), vec2(edge - 1.0));
    uvec2 base = uvec2(at);
    vec2 part = at - vec2(base);
    for (uint corner = 0u; corner < 4u; ++corner) {
        uvec2 offset = uvec2(corner & 1u, corner >> 1u);
        vec2 weights = mix(1.0 - part, part, vec2(offset));
        uvec2 texel = min(base + offset, uvec2(uint(edge) - 1u));
        uint word = causticWord(causticPass.edge, level, texel);
        vec3 counts = flux * (weights.x * weights.y * causticPass.scale);
        // Half a word is more than any path brings.
        uvec4 words = uvec4(min(vec4(counts, dot(counts, vec3(1.0)) * distance) + 0.5, vec4(2147483520.0)));
        for (uint channel = 0u; channel < 4u; ++channel)
            if (words[channel] > 0u) addTo(word + 2u * channel, words[channel]);
    }
}

void main() {
    uint index = linearIndex();
    uint square = causticPass.grid * causticPass.grid,
         lampSquare = causticPass.lampGrid * causticPass.lampGrid;
    if (index >= CAUSTIC_WAYS * square * lampSquare) return;
    CausticEnd self = ends[index];
    if (self.history == 0u) return;
    uint i = index % square, k = index / square % lampSquare;
    vec3 along[4] = {
        spanTo(self, index, i % causticPass.grid, causticPass.grid, 1u),
        spanTo(self, index, i / causticPass.grid, causticPass.grid, causticPass.grid),
        spanTo(self, index, k % causticPass.lampGrid, causticPass.lampGrid, square),
        spanTo(self, index, k / causticPass.lampGrid, causticPass.lampGrid, square * causticPass.lampGrid)};
    // A path without neighbours: a spot as wide as the grid's steps, or as half of its lobe; a unit of the octahedron
    // is a quarter turn
    bool rough = (self.history & CAUSTIC_ROUGH) != 0u;
    float least =
        max(1.0 / float(causticPass.grid), rough ? uintBitsToFloat(self.entry) / kQuarterTurn : 0.0);
    if (length(along[0].xy) + length(along[1].xy) == 0.0) {
        along[0] = vec3(least, 0.0, 0.0);
        along[1] = vec3(0.0, least, 0.0);
    }
    float texels = 0.0;
    for (int axis = 0; axis < 4; ++axis) texels += 0.5 * float(causticPass.edge) * length(along[axis].xy);
    uint level = uint(clamp(floor(log2(max(texels, 1.0) / kTexelsOfLevel)), 0.0, float(CAUSTIC_LEVELS - 1u)));
    texels /= float(1u << level);
    uint places = clamp(uint(texels * texels), 1u, kMostPlaces);
    uint seed = randomHash(index ^ 0x5bd1e995u);
    for (uint n = 0u; n < places; ++n) {
        vec4 part = sequencePoint4(seed, n) - 0.5;
        vec3 at = vec3(self.place, self.distance) + part.x * along[0] + part.y * along[1] +
                  part.z * along[2] + part.w * along[3];
        addLight(at.xy, self.flux / float(places), max(at.z, 0.0), level);
    }
}
