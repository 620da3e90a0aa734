#version 450 core
// SPDX-License-Identifier: MIT
// What faces of a row's cell have learned of the sky -> where rays of pixels are guided (lib/sky_guide.glsl). One group per
// row, of one row in SKY_ROW_PARTS.
#include "shared/irradiance.h"
#include "shared/sky_guide.h"
layout(local_size_x = SKY_ROW_LANES) in;
#define PREFIX_TYPE uint
#define PREFIX_LANES SKY_ROW_LANES
#define PREFIX_CHUNKS 0
#include "lib/prefix_sum.glsl"
layout(std140) uniform CacheBlock { CacheConstants cache; };
layout(std430) buffer SkyLearnedTable { uint skyLearned[]; };
layout(std430) writeonly buffer SkyGuideTable { uint skyGuideTable[]; };

const int kBinsOfLane = SKY_BINS / SKY_ROW_LANES;
// A bin counts so many times beside its four neighbours: cells are large, and other places see a window beside where one
// has found it.
const uint kOfOwn = 4u, kOfAll = 8u;

shared uint words[SKY_GUIDE_WORDS];

uint seenIn(uint learned, ivec2 bin) {
    bin = clamp(bin, ivec2(0), ivec2(SKY_BINS_ACROSS - 1));
    return skyLearned[learned + uint(bin.x + SKY_BINS_ACROSS * bin.y)];
}

uint smoothedBin(uint learned, int index) {
    ivec2 bin = ivec2(index % SKY_BINS_ACROSS, index / SKY_BINS_ACROSS);
    return kOfOwn * seenIn(learned, bin) + seenIn(learned, bin + ivec2(1, 0)) +
           seenIn(learned, bin - ivec2(1, 0)) + seenIn(learned, bin + ivec2(0, 1)) +
           seenIn(learned, bin - ivec2(0, 1));
}

void main() {
    uint row = SKY_ROW_PARTS * gl_WorkGroupID.x + cache.update % SKY_ROW_PARTS;
    uint lane = gl_LocalInvocationIndex;
    uint learned = uint(SKY_LEARNED_WORDS) * row;
    uint rays = skyLearned[learned + uint(SKY_RAYS_AT)];
    if (rays == 0u) return;
    for (uint i = lane; i < uint(SKY_GUIDE_WORDS); i += uint(SKY_ROW_LANES)) words[i] = 0u;

    // Add up
    int first = int(lane) * kBinsOfLane;
    uint seen[kBinsOfLane];
    uint sum = 0u;
    for (int i = 0; i < kBinsOfLane; ++i) {
        seen[i] = smoothedBin(learned, first + i);
        sum += seen[i];
    }
    uint total;
    uint end = prefixBefore(sum, total);
    uint ofFaces = skyLearned[learned + uint(SKY_FACES_AT)];  // lane 0 asks

    // Forget
    if (rays >= SKY_MOST_RAYS) {
        for (int i = 0; i < kBinsOfLane; ++i) skyLearned[learned + uint(first + i)] /= 2u;
        if (lane == 0u) {
            skyLearned[learned + uint(SKY_RAYS_AT)] = rays / 2u;
            skyLearned[learned + uint(SKY_FACES_AT)] = ofFaces / 2u;
        }
    }
    if (total == 0u) {
        if (lane == 0u) skyGuideTable[uint(SKY_GUIDE_WORDS) * row] = 0u;
        return;
    }

    // Give bins slots in proportion
    uint slot = (end * uint(SKY_SLOTS) + total / 2u) / total;
    for (int i = 0; i < kBinsOfLane; ++i) {
        uint bin = uint(first + i);
        end += seen[i];
        uint next = (end * uint(SKY_SLOTS) + total / 2u) / total;
        atomicOr(words[uint(SKY_COUNTS_AT) + bin / 4u], (next - slot) << (8u * (bin & 3u)));
        for (; slot < next; ++slot)
            atomicOr(words[uint(SKY_SLOTS_AT) + slot / 4u], bin << (8u * (slot & 3u)));
    }

    // Share rays by what sky and faces bring, but for what cosine-sampled rays find of the sky as surely
    float ofSky = float(total) / float(kOfAll);
    ofSky *= max(1.0 - ofSky / float(rays), 0.0);
    float others = float(ofFaces) / float(SKY_FACE_PARTS);
    if (lane == 0u) words[0] = floatBitsToUint(ofSky / max(ofSky + others, 1e-6));
    barrier();
    for (uint i = lane; i < uint(SKY_GUIDE_WORDS); i += uint(SKY_ROW_LANES))
        skyGuideTable[uint(SKY_GUIDE_WORDS) * row + i] = words[i];
}
