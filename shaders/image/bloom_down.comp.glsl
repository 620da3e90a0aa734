#version 450 core
// SPDX-License-Identifier: MIT
// A picture -> one of half the pixels, by 13 interpolated taps (Jimenez 2014): half the weight on the four
// about the texel, half on a tent of nine, so that a light that moves by a pixel does not flicker. GPU twin of
// src/image/bloom.cpp.
#include "shared/image.h"
layout(local_size_x = 8, local_size_y = 8) in;
layout(std140) uniform BloomBlock { BloomConstants bloom; };
uniform sampler2D from;
layout(rgba32f) writeonly uniform image2D level;

vec2 size;

vec3 tap(vec2 at) {
    vec3 c = textureLod(from, at / size, float(bloom.fromLevel)).rgb;
    return mix(c, vec3(0.0),
               bvec3(isnan(c.r) || isinf(c.r), isnan(c.g) || isinf(c.g), isnan(c.b) || isinf(c.b)));
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(level)))) return;
    size = vec2(textureSize(from, int(bloom.fromLevel)));
    vec2 at = 2.0 * vec2(pixel) + 1.0;
    vec3 sum = vec3(0.0);
    for (int j = -1; j <= 1; ++j)
        for (int i = -1; i <= 1; ++i)
            sum += 0.03125 * float((2 - abs(i)) * (2 - abs(j))) * tap(at + 2.0 * vec2(i, j));
    for (int j = -1; j <= 1; j += 2)
        for (int i = -1; i <= 1; i += 2) sum += 0.125 * tap(at + vec2(i, j));
    imageStore(level, pixel, vec4(sum, 1.0));
}
