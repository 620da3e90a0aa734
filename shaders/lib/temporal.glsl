// SPDX-License-Identifier: MIT
// What a pixel's surface showed in the picture so far, and how many passes are behind that; and the mean with
// a new value. Reprojection with rejection after Nehab et al. 2007, "Accelerating Real-Time Shading with
// Reverse Reprojection Caching"; docs/theory/4e_pixels.md, "Over frames".
//
// pixelRays.reuse says which (REUSE_* of shared/pixel_rays.h). A picture of the same view has our pixel in its place. Of one
//   of another view (pixelRays.old*), those of the four pixels about the place count that show our surface, by
//   plane, normal and instance. It is no variant: kernels of rays are long, and drivers compile each anew.
// MOTION 1: instances have moved as well. 2: pixels say where they were (hostMotion). Vectors of a host's are of the picture;
//   the surface was as far from the eye then as their z says. Ours, when vertices have moved, are of the world.
#ifndef MOTION
#error MOTION must be 0, 1 or 2
#endif
#include "lib/dot.glsl"
#include "lib/gbuffer.glsl"
#include "lib/pixel_history.glsl"
#include "shared/pixel_rays.h"
layout(std140) uniform PixelRayBlock { PixelRayConstants pixelRays; };
#define EDITS pixelRays
#include "lib/light_change.glsl"
uniform usampler2D pixelHistory;
#if MOTION == 2
uniform sampler2D hostMotion;
#elif MOTION == 1
layout(std430) readonly buffer Motion { mat4 oldFromWorld[]; };
#endif

// The point at a view depth and a clip position of the picture so far.
vec3 oldPoint(vec2 clip, float depth) {
    vec3 across = clip.x * pixelRays.oldRight + clip.y * pixelRays.oldUp;
    vec3 ray = pixelRays.oldForward + clip.x * pixelRays.oldRight + clip.y * pixelRays.oldUp;
    return pixelRays.oldEye + pixelRays.oldParallel * across +
           depth * (pixelRays.oldParallel != 0.0 ? pixelRays.oldForward : ray);
}

struct SoFar {
    vec4 value;      // rgb and number of passes, 0 where there is nothing to go by
    float variance;  // of the brightness of one pass
};

SoFar soFarOf(uvec4 bits) {
    float deviation = pixelHistoryDeviation(bits);
    return SoFar(vec4(pixelHistoryValue(bits), pixelHistoryCount(bits)), deviation * deviation);
}

// Where a surface was when the picture so far was gathered.
struct SurfaceSoFar {
    vec3 position;
    vec3 normal;
    vec3 planeNormal;
    vec4 clip;
};

SurfaceSoFar surfaceSoFar(ivec2 pixel, Surface s) {
    vec3 position = s.position;
    vec3 normal = s.normal;
    vec3 planeNormal = s.geometricNormal;
#if MOTION == 1
    mat4 motion = oldFromWorld[s.instance];
    position = (motion * vec4(position, 1.0)).xyz;
    normal = normalize(mat3(motion) * normal);
    planeNormal = normalize(mat3(motion) * planeNormal);
#endif
#if MOTION == 2
    bool ofWorld = pixelRays.motionStep == 0u;
    vec4 moved = texelFetch(hostMotion, pixel * max(int(pixelRays.motionStep), 1), 0);
    position += ofWorld ? moved.xyz : vec3(0.0);
#endif
    vec4 clip = pixelRays.oldClipFromWorld * vec4(position, 1.0);
#if MOTION == 2
    // The host's vector in place of what the matrices say
    vec2 toPart = vec2(pixelRays.motionScaleX, pixelRays.motionScaleY);
    vec2 here = (vec2(pixel) + 0.5) / vec2(frame.width, frame.height);
    clip.xy = ofWorld ? clip.xy : (2.0 * (here + moved.xy * toPart) - 1.0) * clip.w;
    float oldDepth = pixelRays.oldParallel != 0.0 ? clip.z : clip.w;
    position = ofWorld ? position : oldPoint(clip.xy / max(clip.w, 1e-6), oldDepth + moved.z);
    // Nobody knows where it was.
    clip.w = ofWorld && moved.a < 0.0 ? 0.0 : clip.w;
#endif
    return SurfaceSoFar(position, normal, planeNormal, clip);
}

// Whether surface and eye are where they were, so that it reflects what it did.
bool reflectsTheSame(ivec2 pixel, Surface s) {
    vec3 apart = surfaceSoFar(pixel, s).position - s.position;
    bool sameEye =
        pixelRays.oldEye == frame.eye && (frame.parallel == 0.0 || pixelRays.oldForward == frame.viewForward);
    return pixelRays.reuse == REUSE_SAME_VIEW || (sameEye && dot(apart, apart) <= 1e-8 * s.depth * s.depth);
}

SoFar valueSoFar(ivec2 pixel, Surface s) {
    SurfaceSoFar old = surfaceSoFar(pixel, s);
    vec4 clip = old.clip;
    ivec2 size = textureSize(pixelHistory, 0);
    vec2 place = (clip.xy / max(clip.w, 1e-6) * 0.5 + 0.5) * vec2(size) - 0.5;
    // Where the view has hardly changed, rounding must not blur.
    vec2 nearest = floor(place + 0.5);
    place = mix(place, nearest, lessThan(abs(place - nearest), vec2(0.02)));
    bool sameView = pixelRays.reuse == REUSE_SAME_VIEW;
    vec2 base = sameView ? vec2(pixel) : floor(place);
    vec2 part = sameView ? vec2(0.0) : place - base;
    // Software drivers go through all of a branch that no pixel takes, but not through all of a loop.
    int taps = sameView ? 1 : (pixelRays.reuse == REUSE_NONE ? 0 : 4);
    SoFar sum = SoFar(vec4(0.0), 0.0);
    float weight = 0.0;
    for (int i = 0; i < taps; ++i) {
        ivec2 offset = ivec2(i & 1, i >> 1);
        ivec2 q = ivec2(base) + offset;
        bool inside = clip.w > 0.0 && all(greaterThanEqual(q, ivec2(0))) && all(lessThan(q, size));
        uvec4 bits = texelFetch(pixelHistory, clamp(q, ivec2(0), size - 1), 0);
        vec2 at = (vec2(q) + 0.5) / vec2(size) * 2.0 - 1.0;
        vec3 there = oldPoint(at, pixelHistoryDepth(bits));
        bool same = inside && bits.z != 0u && pixelHistoryInstance(bits) == (s.instance & 0xffu) &&
                    dot(pixelHistoryNormal(bits), old.normal) > 0.9 &&
                    abs(dot(there - old.position, old.planeNormal)) < pixelRays.planeTolerance;
        same = sameView ? bits.z != 0u : same;
        vec2 w = mix(1.0 - part, part, vec2(offset));
        float tap = same ? w.x * w.y : 0.0;
        SoFar tapSoFar = soFarOf(bits);
        sum.value += tap * tapSoFar.value;
        sum.variance += tap * tapSoFar.variance;
        weight += tap;
    }
    // Less than a twentieth of a pixel is rounding.
    float scale = weight > 0.05 ? 1.0 / weight : 0.0;
    return SoFar(scale * sum.value, scale * sum.variance);
}

// The picture so far with light as it is now, where a factor makes it that; and the part that is another still.
float scaledToNow(inout SoFar soFar, vec3 position) {
    bool scales = isBetterScaled(position, soFar.value.rgb);
    if (scales) {
        vec3 scaled = pixelRays.lightScale * soFar.value.rgb;
        float scale = pixelBrightness(scaled) / max(pixelBrightness(soFar.value.rgb), 1e-12);
        soFar.value.rgb = scaled;
        soFar.variance *= scale * scale;
    }
    return changedLight(position, soFar.value.rgb, scales);
}

// Passes that a mean is of at most at `position`, where `light` is the part of it that is another: the fewer, the nearer to
// what changed. Of light the shortest lags by no more than one pass is noisy.
float longestMeanAt(vec3 position, float light) {
    float changed = 1e-6;
    for (uint i = 0u; i < pixelRays.placeCount; ++i) {
        uint at = editPlace(i);
        changed += changedPart(position, pixelRays.places[at], pixelRays.placeParts[at >> 2][at & 3u]);
    }
    float shortest =
        clamp(IRRADIANCE_NOISE / max(light, 1e-6), pixelRays.shortestLightMean, pixelRays.shortestMean);
    return clamp(1.0 / weightAfterChange(changed + light), shortest, pixelRays.longestMean);
}

// The same of what a smooth surface shows about `axis`: the fewer, the more of what changed is there. What a light shines
// on may be anywhere.
float longestLobeMean(vec3 position, vec3 axis, float spread, float light) {
    float changed = light > 0.0 ? 1.0 : 1e-6;
    for (uint i = 0u; i < pixelRays.placeCount; ++i)
        changed += changedInLobe(position, axis, spread, pixelRays.places[editPlace(i)]);
    return clamp(1.0 / weightAfterChange(changed), pixelRays.shortestLobeMean, pixelRays.longestMean);
}

// The mean of what was so far and one more pass; `longest` passes at most, so that change gets through.
uvec4 withPass(SoFar soFar, Surface s, bool seen, vec3 value, float longest) {
    float count = min(floor(soFar.value.a), longest - 1.0) + 1.0;
    vec3 mean = mix(soFar.value.rgb, value, 1.0 / count);
    // Welford 1962, "Note on a Method for Calculating Corrected Sums of Squares and Products".
    float square = (pixelBrightness(value) - pixelBrightness(soFar.value.rgb)) *
                   (pixelBrightness(value) - pixelBrightness(mean));
    float variance = count > 1.0 ? mix(soFar.variance, square, 1.0 / count) : 0.0;
    return packPixelHistory(
        PixelHistory(mean, sqrt(max(variance, 0.0)), count, seen ? s.depth : 0.0, s.normal, s.instance));
}
