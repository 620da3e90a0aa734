#version 450 core
// SPDX-License-Identifier: MIT
// One level of an edge-stopping filter over a gathered picture (lib/pixel_history.glsl): 3x3 taps FILTER_STEP
// pixels apart, weights 1 2 1. Levels of 1, 2, 4 pixels after each other reach over 3, 7, 15 pixels
// (a-trous wavelets: Dammertz et al. 2010, "Edge-Avoiding A-Trous Wavelet Transform for fast Global
// Illumination Filtering"). A tap counts by its normal (power 32) and its distance from the pixel's plane in
// voxels, and only on the same instance with no other surface half way between: so light does not cross thin
// walls. SPECULAR 1: only pixels of the lobes' list (the caller clears the others); the reach grows
// with roughness, none at a mirror, less where the surface is curved; how fast is fitted to builtin:glossy
// and builtin:spheres (least error, qualities draft and interactive).
#if !defined(FILTER_STEP) || !defined(SPECULAR)
#error FILTER_STEP must be 1, 2, 4 or 8, SPECULAR 0 or 1
#endif
#include "lib/dot.glsl"
#include "lib/gbuffer.glsl"
#include "lib/pixel_history.glsl"
#include "lib/voxel_grid.glsl"
#include "shared/pixel_rays.h"
layout(std140) uniform PixelRayBlock { PixelRayConstants pixelRays; };
uniform usampler2D source;
layout(local_size_x = 8, local_size_y = 8) in;
#if SPECULAR
#define LOBE_LIST_ACCESS readonly
#include "lib/lobe_list.glsl"
#else
#include "lib/picture_pass.glsl"
#endif
layout(rgba32ui) writeonly uniform uimage2D result;

// The eight neighbours, row by row: all but the middle of 3x3.
ivec2 neighbour(int i) {
    int k = i < 4 ? i : i + 1;
    return ivec2(k % 3, k / 3) - 1;
}

float tapWeight(ivec2 offset) { return offset.x == 0 || offset.y == 0 ? 2.0 : 1.0; }

// Pixels that differ by more than so many standard deviations, and this part of what both show, show another
// light.
const float kUnlike = 4.0;
const float kAlwaysAlike = 0.05;
// The standard deviation of a ray's light, over the mean, is taken for this before any pass has shown it; it
// counts as much as one pass.
const float kAssumedNoise = 1.5;

// Of the mean that a pixel shows. Passes complement each other: noise of n falls a little faster than n^-0.5.
float meanVariance(uvec4 bits) {
    float deviation = pixelHistoryDeviation(bits);
    float variance = deviation * deviation;
#if FILTER_STEP == 1
    float passes = max(pixelHistoryCount(bits), 1.0);
    float assumed = kAssumedNoise * pixelBrightness(pixelHistoryValue(bits));
    float root = inversesqrt(passes);
    variance = (variance + assumed * assumed / (float(pixelRays.rays) * passes)) * root * root * sqrt(root);
#endif
    return variance;
}

vec3 positionOf(ivec2 pixel, uvec4 bits) {
    return pixelOrigin(pixel) + pixelHistoryDepth(bits) * pixelRay(pixel);
}

// The pixel that is filtered.
struct OwnPixel {
    ivec2 at;
    uvec4 bits;
    vec3 position;
    vec3 normal;
};

OwnPixel ownPixel(ivec2 size) {
#if SPECULAR
    ivec2 pixel = listedPixel(size);
#else
    ivec2 pixel = passPixel();
#endif
    uvec4 bits = texelFetch(source, min(pixel, size - 1), 0);
    return OwnPixel(pixel, bits, positionOf(pixel, bits), pixelHistoryNormal(bits));
}

// Its neighbours, as readTaps finds them.
uvec4 taps[8];
uint same;          // bit i: the pixel's instance (an array of bool is invalid SPIR-V through Mesa's zink)
float cosines[8];   // of the normals
float offPlane[8];  // from the pixel's plane, voxels
float perMetre;     // voxels there

bool isSame(int i) { return (same >> i & 1u) != 0u; }

void readTaps(OwnPixel own, ivec2 size) {
    perMetre = pixelRays.inverseVoxelSize;
#if NESTED_GRIDS
    perMetre /= voxelEdgeAt(gridFromWorld(own.position));
#endif
    same = 0u;
    for (int i = 0; i < 8; ++i) {
        ivec2 q = own.at + FILTER_STEP * neighbour(i);
        uvec4 bits = texelFetch(source, clamp(q, ivec2(0), size - 1), 0);
        bool inside = all(greaterThanEqual(q, ivec2(0))) && all(lessThan(q, size));
        bool alike = inside && bits.z != 0u && pixelHistoryInstance(bits) == pixelHistoryInstance(own.bits);
        same |= alike ? 1u << i : 0u;
        cosines[i] = dot(pixelHistoryNormal(bits), own.normal);
        offPlane[i] = dot(positionOf(q, bits) - own.position, own.normal) * perMetre;
        taps[i] = bits;
    }
}

#if SPECULAR
// What neighbours may share of the lobe.
struct Likeness {
    float reach;
    float alpha;  // GGX's
};

Likeness likenessOf(OwnPixel own, ivec2 size) {
#if SURFACE_COATS
    uint bits = texelFetch(surfaceLayers, min(own.at, size - 1), 0).y;
#else
    uint bits = texelFetch(gbufferMaterial, min(own.at, size - 1), 0).y;
#endif
    float roughness = unpackUnorm2x16(bits).y;
    // Neighbours share the less the more rays there are: from 5 with 16 of them down to 2 with 100.
    float count = max(pixelHistoryCount(own.bits), 1.0) * float(pixelRays.rays);
    float nearby = clamp(20.0 * inversesqrt(count), 2.0, 5.0);
    float reach = clamp((FILTER_STEP == 1 ? nearby : 2.0 / float(FILTER_STEP)) * roughness, 0.0, 1.0);
    reach *= reach;
    return Likeness(reach, max(roughness * roughness, 1e-3));
}

// A normal turned by alpha shows what lies a whole lobe beside.
float shareOf(int i, Likeness own) {
    return max(1.0 - 2.0 * (1.0 - cosines[i]) / (own.alpha * own.alpha), 0.0);
}
#else
// The light that neighbours are compared with, and how much noise there is in it.
struct Likeness {
    float reach;
    vec3 value;
    float variance;
};

// How much noise there is, few passes do not say: the mean over neighbours does. Pixels that no ray found
// light for all seem to know that they are dark.
Likeness likenessOf(OwnPixel own, ivec2 size) {
    vec3 alike = pixelHistoryValue(own.bits);
    float ownVariance = meanVariance(own.bits);
    vec2 variance = 4.0 * vec2(ownVariance, 1.0);
    vec3 least = vec3(1e30);
    vec3 most = vec3(0.0);
    for (int i = 0; i < 8; ++i) {
        vec3 value = pixelHistoryValue(taps[i]);
        bool surface = isSame(i) && cosines[i] > 0.9 && abs(offPlane[i]) < 0.5;
        variance += surface ? tapWeight(neighbour(i)) * vec2(meanVariance(taps[i]), 1.0) : vec2(0.0);
        least = surface ? min(least, value) : least;
        most = surface ? max(most, value) : most;
    }
#if FILTER_STEP == 1
    // What is unlike all of its neighbours is noise, not another light: it is told from them by the least or
    // most of them.
    alike = least.r < 1e30 ? clamp(alike, least, most) : alike;
#endif
    return Likeness(1.0, alike, max(variance.x / variance.y, ownVariance));
}

// A pixel with much noise is not told from the others by it, or the mean would be of dark ones only.
float shareOf(int i, Likeness own) {
    float noise2 = kUnlike * kUnlike * (own.variance + max(own.variance, meanVariance(taps[i])));
    float alwaysAlike = kAlwaysAlike * pixelBrightness(own.value + pixelHistoryValue(taps[i]));
    float apart = pixelBrightness(abs(own.value - pixelHistoryValue(taps[i])));
    return max(1.0 - apart * apart / max(noise2 + alwaysAlike * alwaysAlike, 1e-12), 0.0);
}
#endif

// Whether no other surface lies half way to a tap.
bool isFreeBetween(int i, OwnPixel own, ivec2 size) {
#if FILTER_STEP > 1
    ivec2 pixel = own.at + FILTER_STEP / 2 * neighbour(i);
    uvec4 middle = texelFetch(source, clamp(pixel, ivec2(0), size - 1), 0);
    float middleOff = dot(positionOf(pixel, middle) - own.position, own.normal);
    return pixelHistoryInstance(middle) == pixelHistoryInstance(own.bits) && abs(middleOff) * perMetre < 0.5;
#else
    return true;
#endif
}

// Weight of a tap that counts, by how its surface lies.
float surfaceWeight(int i, float reach) {
    float turned = max(cosines[i], 0.0);
    turned *= turned;
    turned *= turned;
    turned *= turned;
    turned *= turned;
    turned *= turned;
    return turned * reach * max(1.0 - 4.0 * offPlane[i] * offPlane[i], 0.0);
}

void main() {
    ivec2 size = imageSize(result);
    OwnPixel own = ownPixel(size);
    readTaps(own, size);
    Likeness likeness = likenessOf(own, size);

    // Sum what shows the same surface in the same light.
    vec3 sum = 4.0 * pixelHistoryValue(own.bits);
    float weights = 4.0;
#if !SPECULAR
    float variances = 16.0 * likeness.variance;
#endif
    for (int i = 0; i < 8; ++i) {
        float tap = tapWeight(neighbour(i)) * shareOf(i, likeness);
        bool counts = isSame(i) && isFreeBetween(i, own, size);
        tap *= counts ? surfaceWeight(i, likeness.reach) : 0.0;
        sum += tap * pixelHistoryValue(taps[i]);
        weights += tap;
#if !SPECULAR
        variances += tap * tap * meanVariance(taps[i]);
#endif
    }

    // Store the mean, with the deviation that is left in it.
    if (any(greaterThanEqual(own.at, size))) return;
#if SPECULAR
    float deviation = pixelHistoryDeviation(own.bits);
#else
    float deviation = sqrt(variances) / weights;
#endif
    vec3 value = own.bits.z != 0u ? sum / weights : vec3(0.0);
    imageStore(result, own.at,
               uvec4(packHalf2x16(value.rg), packHistoryBlue(value.b, deviation), own.bits.zw));
}
