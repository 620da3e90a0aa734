#version 450 core
// SPDX-License-Identifier: MIT
// Linear radiance -> 8-bit picture for a screen: exposure, tone curve, sRGB. GPU twin of
// src/image/tone_map.cpp, which has the sources of the curves; turned so that row 0 is the top row.
layout(local_size_x = 8, local_size_y = 8) in;
#include "shared/image.h"
layout(std140) uniform DisplayBlock { DisplayConstants display; };
uniform sampler2D linearImage;
layout(rgba8) uniform writeonly image2D displayImage;

const float kWhite = 1e6;  // see tone_map.cpp

vec3 toneCurve(vec3 c) {
    vec3 reinhard = c / (1.0 + dot(c, vec3(0.2126, 0.7152, 0.0722)));
    vec3 aces = (c * (2.51 * c + 0.03)) / (c * (2.43 * c + 0.59) + 0.14);
    return display.curve == 0u ? c : display.curve == 1u ? reinhard : aces;
}

vec3 srgbFromLinear(vec3 c) {
    vec3 curved = 1.055 * pow(max(c, vec3(1e-8)), vec3(1.0 / 2.4)) - 0.055;
    return mix(curved, 12.92 * c, lessThanEqual(c, vec3(0.0031308)));
}

void main() {
    ivec2 size = textureSize(linearImage, 0);
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (pixel.x >= size.x || pixel.y >= size.y) return;
    vec3 color = texelFetch(linearImage, ivec2(pixel.x, size.y - 1 - pixel.y), 0).rgb;
    color = mix(color, vec3(0.0), isnan(color));
    color = clamp(toneCurve(clamp(color * display.scale, 0.0, kWhite)), 0.0, 1.0);
    color = display.srgb != 0u ? srgbFromLinear(color) : color;
    imageStore(displayImage, pixel, vec4(color, 1.0));
}
