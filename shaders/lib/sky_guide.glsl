// SPDX-License-Identifier: MIT
// Rays that are guided to a constant sky: each cell of places (lib/light_cells.glsl) has a histogram over directions, of the rays
// of faces that saw the sky. Rays of pixels are drawn by it, so that rooms find their windows. Part of lib/voxel_light.glsl.
// Method: docs/theory/4c_estimator.md, "Windows".
//
// LEARNS_SKY 1: rays are counted, none is guided. Rays that were guided by what those of their own sequence found would
// have another mean.
#ifndef SKY_GUIDE
#define SKY_GUIDE 0
#endif
#ifndef LEARNS_SKY
#define LEARNS_SKY 0
#endif
#if SKY_GUIDE && !LEARNS_SKY
#define GUIDED_RAYS 1
#else
#define GUIDED_RAYS 0
#endif
#include "lib/dot.glsl"
#include "lib/face_shading.glsl"
#include "lib/light_cells.glsl"
#include "lib/octahedral.glsl"
#include "shared/sky_guide.h"

// Cells stand still here, so that they remember.
int skyRowAt(vec3 point, vec3 normal) { return cellAt(point, normal, 0u).row; }

int skyBin(vec3 direction) {
    vec2 place = (0.5 * octEncode(direction) + 0.5) * float(SKY_BINS_ACROSS);
    ivec2 at = clamp(ivec2(place), ivec2(0), ivec2(SKY_BINS_ACROSS - 1));
    return at.x + SKY_BINS_ACROSS * at.y;
}

#if GUIDED_RAYS
uniform usamplerBuffer skyGuide;

// Share of light-sampled rays that go to the sky.
float skyShareOfRow(int row) { return uintBitsToFloat(texelFetch(skyGuide, SKY_GUIDE_WORDS * row).x); }

uint skyByte(int row, int at, int index) {
    uint word = texelFetch(skyGuide, SKY_GUIDE_WORDS * row + at + (index >> 2)).x;
    return (word >> (8 * (index & 3))) & 255u;
}

vec3 guidedDirection(int row, vec3 xi) {
    int bin = int(skyByte(row, SKY_SLOTS_AT, min(int(xi.x * float(SKY_SLOTS)), SKY_SLOTS - 1)));
    vec2 place = vec2(bin % SKY_BINS_ACROSS, bin / SKY_BINS_ACROSS) + xi.yz;
    return octDecode(place * (2.0 / float(SKY_BINS_ACROSS)) - 1.0);
}

// Density per steradian of a direction among guided rays (4.66).
float guidedPdf(int row, vec3 direction) {
    float slots = float(skyByte(row, SKY_COUNTS_AT, skyBin(direction)));
    float sum = abs(direction.x) + abs(direction.y) + abs(direction.z);
    return slots * (float(SKY_BINS) / (4.0 * float(SKY_SLOTS))) / (sum * sum * sum);
}
#endif

#if SKY_GUIDE && LEARNS_SKY
layout(std430) buffer SkyLearnedTable { uint skyLearned[]; };

int learningRow = -1;        // of the rays that are counted
float learnedOfFaces = 0.0;  // what they brought that met faces, over what the sky brings

// A face that shines brighter than so many skies counts as these, so that sums of SKY_MOST_RAYS rays fit into a word.
const float kMostSkies = 4096.0;

void learnSky(VoxelHit hit, vec3 direction, vec3 radiance) {
    if (hit.face >= 0)
        learnedOfFaces += min(brightness(radiance) / max(brightness(lighting.sky), 1e-20), kMostSkies);
    else if (learningRow >= 0)
        atomicAdd(skyLearned[SKY_LEARNED_WORDS * learningRow + skyBin(direction)], 1u);
}

void endLearning(uint rays) {
    int row = SKY_LEARNED_WORDS * learningRow;
    atomicAdd(skyLearned[row + SKY_RAYS_AT], rays);
    atomicAdd(skyLearned[row + SKY_FACES_AT], uint(float(SKY_FACE_PARTS) * learnedOfFaces + 0.5));
}
#define LEARN_SKY(learns, hit, direction, radiance) \
    if (learns) learnSky(hit, direction, radiance)
#else
#define LEARN_SKY(learns, hit, direction, radiance)
#endif
