#version 450 core
// SPDX-License-Identifier: MIT
// A view at an offset within the pixels + the picture before -> the picture, and what is known of it for the
// next (docs/theory/5_image.md, "Over frames").
//   STILL 1: nothing has changed: the mean of all views so far
//   STILL 0: the picture before is looked up where the surface was (reprojection as in lib/temporal.glsl), left out
//            where that was hidden, and clipped to what the view shows about the pixel (Salvi 2016)
//   VERTICES 1: vertices have moved, and surfaceMotion says where surfaces were (view/motion_picture.h)
#ifndef VERTICES
#error VERTICES must be 0 or 1
#endif
#ifndef STILL
#error STILL must be 0 or 1
#endif
#include "lib/dot.glsl"
#include "lib/frame_block.glsl"
#include "lib/gbuffer.glsl"
#include "lib/picture_pass.glsl"
#include "shared/image.h"
layout(local_size_x = 8, local_size_y = 8) in;
layout(std140) uniform TemporalBlock { TemporalPictureConstants temporal; };
#if VERTICES
uniform sampler2D surfaceMotion;
#elif !STILL
layout(std430) readonly buffer Motion { mat4 oldFromWorld[]; };
#endif
uniform sampler2D view;
uniform sampler2D pictureBefore;
// View depth, 22 bits of a float without its sign; 10 bits: number of views. The sky is at depth kSky.
uniform usampler2D placesBefore;
layout(r32ui) writeonly uniform uimage2D places;
layout(rgba32f) writeonly uniform image2D picture;

const float kSky = 1e30;

float depthAt(ivec2 pixel) {
    uint bits = texelFetch(gbufferGeometry, pixel, 0).x;
    return bits != 0u ? uintBitsToFloat(bits) : kSky;
}
uint packPlace(float depth, float count) {
    return ((floatBitsToUint(depth) + 0x100u) >> 9) << 10 | uint(min(count, 1023.0));
}
float placeDepth(uint bits) { return uintBitsToFloat((bits & ~0x3ffu) >> 1); }
float placeCount(uint bits) { return float(bits & 0x3ffu); }

#if !STILL
// Deviations about the mean that the picture before may lie in: fewer flicker, more lag (1 in Salvi 2016).
const float kDeviations = 1.0;
// Of the depth: how exactly the surface must be where one was seen.
const float kDepthTolerance = 0.02;

float luminance(vec3 c) { return dot(c, vec3(0.2126, 0.7152, 0.0722)); }

// Of the nine pixels about it, the one whose surface is nearest: on an edge both sides move as the nearer one.
ivec2 nearestAround(ivec2 pixel, ivec2 size) {
    ivec2 nearest = pixel;
    float least = depthAt(pixel);
    for (int i = 0; i < 9; ++i) {
        ivec2 q = clamp(pixel + ivec2(i % 3, i / 3) - 1, ivec2(0), size - 1);
        float depth = depthAt(q);
        nearest = depth < least ? q : nearest;
        least = min(depth, least);
    }
    return nearest;
}

// Where the surface of a pixel was in the picture before, pixels; z: its depth there, 0 where nobody knows.
vec3 placeBefore(ivec2 pixel, vec2 size) {
    float depth = depthAt(pixel);
    vec3 ray = pixelRay(pixel);
    bool parallel = temporal.oldParallel != 0.0;
    // Parallel rays all see one place of the sky: it was here.
    if (parallel && depth >= kSky) return vec3(pixel, kSky);
    vec4 clip = temporal.oldClipFromWorld * vec4(ray, 0.0);
    float known = 1.0, before = kSky;
    if (depth < kSky) {
        vec4 old = vec4(pixelOrigin(pixel) + depth * ray, 1.0);
#if VERTICES
        vec4 moved = texelFetch(surfaceMotion, pixel, 0);
        old.xyz += moved.xyz;
        known = moved.a < 0.0 ? 0.0 : 1.0;
#else
        mat4 motion = oldFromWorld[texelFetch(gbufferGeometry, pixel, 0).w >> 2];
        old = motion * old;
        known = motion[3][3];
#endif
        clip = temporal.oldClipFromWorld * old;
        before = parallel ? dot(temporal.oldDepth, old) : clip.w;
    }
    vec2 place = (clip.xy / max(clip.w, 1e-6) * 0.5 + 0.5) * size - 0.5;
    return vec3(place, clip.w > 0.0 && known > 0.0 ? before : 0.0);
}

// Weights of four texels in a row about a place between the second and the third (Catmull and Rom 1974).
vec4 cubicWeights(float t) {
    float t2 = t * t, t3 = t2 * t;
    return vec4(-0.5 * t + t2 - 0.5 * t3, 1.0 - 2.5 * t2 + 1.5 * t3, 0.5 * t + 2.0 * t2 - 1.5 * t3,
                -0.5 * t2 + 0.5 * t3);
}

// The picture before at a place, and how many views are in it: 0 where another surface was seen there.
vec4 lookUp(vec3 place, ivec2 size, out float count) {
    // Where the view has hardly changed, rounding must not blur.
    vec2 nearest = floor(place.xy + 0.5);
    vec2 at = mix(place.xy, nearest, lessThan(abs(place.xy - nearest), vec2(0.02)));
    ivec2 base = ivec2(floor(at));
    vec2 part = at - vec2(base);
    vec4 wx = cubicWeights(part.x), wy = cubicWeights(part.y);
    vec4 sum = vec4(0.0);
    float low = 2.0 * kSky, high = 0.0;
    for (int i = 0; i < 16; ++i) {
        ivec2 q = clamp(base + ivec2(i & 3, i >> 2) - 1, ivec2(0), size - 1);
        sum += wx[i & 3] * wy[i >> 2] * texelFetch(pictureBefore, q, 0);
        float depth = placeDepth(texelFetch(placesBefore, q, 0).x);
        low = min(low, depth);
        high = max(high, depth);
    }
    bool inside = all(greaterThanEqual(nearest, vec2(0.0))) && all(lessThan(nearest, vec2(size)));
    bool seen = place.z > low * (1.0 - kDepthTolerance) && place.z < high * (1.0 + kDepthTolerance);
    count = placeCount(texelFetch(placesBefore, clamp(ivec2(nearest), ivec2(0), size - 1), 0).x);
    if (!inside || !seen) count = 0.0;
    return max(sum, vec4(0.0));
}

// Colours as the eye tells them apart: c / (l + brightness), so that a lamp is not all there is to see; l is the
// mean about the pixel. In luma and two differences, where what is near is alike.
vec3 lookOf(vec3 c, float l) {
    vec3 shown = c / (l + luminance(c));
    return vec3(0.25 * shown.r + 0.5 * shown.g + 0.25 * shown.b, shown.r - shown.b,
                shown.g - 0.5 * (shown.r + shown.b));
}
vec3 colorOf(vec3 look, float l) {
    float g = look.x + 0.5 * look.z, rest = look.x - 0.5 * look.z;
    vec3 shown = max(vec3(rest + 0.5 * look.y, g, rest - 0.5 * look.y), vec3(0.0));
    return shown * l / max(1.0 - luminance(shown), 1e-3);
}

// The picture before, brought to what the view shows about the pixel.
vec4 clipped(vec4 before, ivec2 pixel, ivec2 size) {
    vec4 about[9];
    float brightness = 0.0;
    for (int i = 0; i < 9; ++i) {
        about[i] = texelFetch(view, clamp(pixel + ivec2(i % 3, i / 3) - 1, ivec2(0), size - 1), 0);
        brightness += luminance(about[i].rgb);
    }
    float l = max(brightness / 9.0, 1e-6);
    vec3 mean = vec3(0.0), square = vec3(0.0);
    float least = 1.0, most = 0.0;
    for (int i = 0; i < 9; ++i) {
        vec3 look = lookOf(about[i].rgb, l);
        mean += look / 9.0;
        square += look * look / 9.0;
        least = min(least, about[i].a);
        most = max(most, about[i].a);
    }
    vec3 reach = kDeviations * sqrt(max(square - mean * mean, vec3(0.0))) + 1e-4;
    // Along the line to the mean, so that hues stay.
    vec3 away = lookOf(before.rgb, l) - mean;
    vec3 over = abs(away) / reach;
    float most3 = max(over.x, max(over.y, over.z));
    vec3 color = most3 > 1.0 ? colorOf(mean + away / most3, l) : before.rgb;
    return vec4(color, clamp(before.a, least, most));
}
#endif

void main() {
    ivec2 pixel = passPixel();
    ivec2 size = imageSize(picture);
    if (any(greaterThanEqual(pixel, size))) return;
    vec4 value = texelFetch(view, pixel, 0);
    float count = 0.0;
    vec4 before = value;
#if STILL
    before = texelFetch(pictureBefore, pixel, 0);
    count = placeCount(texelFetch(placesBefore, pixel, 0).x);
#else
    if (temporal.fresh == 0u) {
        ivec2 nearest = nearestAround(pixel, size);
        vec3 place = placeBefore(nearest, vec2(size));
        place.xy += vec2(pixel - nearest);
        before = lookUp(place, size, count);
        before = clipped(before, pixel, size);
    }
#endif
    count = min(count, float(temporal.longest) - 1.0) + 1.0;
    value = count > 1.0 ? before + (value - before) / count : value;
    imageStore(picture, pixel, value);
    imageStore(places, pixel, uvec4(packPlace(depthAt(pixel), count), 0u, 0u, 0u));
}
