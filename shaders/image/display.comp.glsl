#version 450 core
// SPDX-License-Identifier: MIT
// Linear radiance -> 8-bit picture for a screen: exposure, tone curve, sRGB. GPU twin of
// src/image/tone_map.cpp, which has the sources of the curves.
//   BLOOM 1: part of the light has spread (bloom_up.comp.glsl)
#ifndef BLOOM
#error BLOOM must be 0 or 1
#endif
layout(local_size_x = 8, local_size_y = 8) in;
#include "lib/dot.glsl"
#include "shared/image.h"
layout(std140) uniform DisplayBlock { DisplayConstants display; };
layout(std140) uniform ExposureBlock { Exposure exposure; };
uniform sampler2D linearImage;
#if BLOOM
uniform sampler2D bloomChain;
#include "image/bloom_tent.glsl"
#endif
layout(rgba8) uniform writeonly image2D displayImage;

const float kWhite = 1e6;  // see tone_map.cpp

vec3 agx(vec3 c) {
    const mat3 inset = mat3(0.842479062, 0.042328242, 0.042375655, 0.0784336, 0.878468636, 0.0784336,
                            0.079223745, 0.079166127, 0.879142974);
    const mat3 outset = mat3(1.196879005, -0.052896852, -0.052971636, -0.098020881, 1.151903130, -0.098043450,
                             -0.099029744, -0.098961177, 1.151073673);
    vec3 x = clamp((log2(max(inset * c, vec3(1e-10))) + 12.47393) / 16.5, 0.0, 1.0);
    vec3 x2 = x * x, x4 = x2 * x2;
    vec3 curved =
        15.5 * x4 * x2 - 40.14 * x4 * x + 31.96 * x4 - 6.868 * x2 * x + 0.4298 * x2 + 0.1191 * x - 0.00232;
    return pow(max(outset * curved / 0.99858, vec3(0.0)), vec3(2.2));
}

vec3 neutral(vec3 c) {
    const float start = 0.76, room = 0.24, desaturation = 0.15;
    float least = min(c.r, min(c.g, c.b));
    c -= least < 0.08 ? least - 6.25 * least * least : 0.04;
    float peak = max(c.r, max(c.g, c.b));
    float shown = 1.0 - room * room / (max(peak, start) + room - start);
    vec3 white = vec3(shown);
    vec3 squeezed = mix(white, c * (shown / max(peak, start)), 1.0 / (desaturation * (peak - shown) + 1.0));
    return peak < start ? c : squeezed;
}

vec3 toneCurve(vec3 c) {
    switch (display.curve) {
        case 1u:
            return c / (1.0 + dot(c, vec3(0.2126, 0.7152, 0.0722)));
        case 2u:
            return (c * (2.51 * c + 0.03)) / (c * (2.43 * c + 0.59) + 0.14);
        case 3u:
            return agx(c);
        case 4u:
            return neutral(c);
        default:
            return c;
    }
}

vec3 srgbFromLinear(vec3 c) {
    vec3 curved = 1.055 * pow(max(c, vec3(1e-8)), vec3(1.0 / 2.4)) - 0.055;
    return mix(curved, 12.92 * c, lessThanEqual(c, vec3(0.0031308)));
}

// Display values (0 to 1) of a pixel that a check marks, or those it has.
vec3 clippingMarked(vec3 shown, ivec2 pixel) {
    bool over = any(greaterThanEqual(shown, vec3(254.5 / 255.0)));
    bool under = all(lessThan(shown, vec3(0.5 / 255.0)));
    bool stripe = ((pixel.x + pixel.y) / CLIPPING_STRIPE & 1) == 0;
    vec3 mark = over ? vec3(1.0, 0.0, 0.25) : vec3(0.0, 0.25, 1.0);
    return stripe && (over || under) ? mark : shown;
}

vec3 falseColor(float luminance) {
    float stops = log2(max(luminance, 1e-10) / EXPOSURE_GREY);
    return display.falseColors[int(clamp(stops + FALSE_COLOR_OFFSET, 0.0, float(FALSE_COLORS - 1)))].rgb;
}

void main() {
    ivec2 size = textureSize(linearImage, 0);
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);  // from the top
    if (pixel.x >= size.x || pixel.y >= size.y) return;
    vec3 color = texelFetch(linearImage, ivec2(pixel.x, size.y - 1 - pixel.y), 0).rgb;
#if BLOOM
    vec3 spread = bloomTent(bloomChain, 0, ivec2(pixel.x, size.y - 1 - pixel.y));
    color = display.kept * color + display.spread * spread;
#endif
    color = mix(color, vec3(0.0), isnan(color));
    mat3 balance = mat3(display.balance[0].xyz, display.balance[1].xyz, display.balance[2].xyz);
    vec3 light = clamp(balance * min(color, vec3(1e30)) * exposure.scale, 0.0, kWhite);
    color = clamp(toneCurve(light), 0.0, 1.0);
    color = display.srgb != 0u ? srgbFromLinear(color) : color;
    if (display.check == 1u) color = clippingMarked(color, pixel);
    if (display.check == 2u) color = falseColor(dot(light, vec3(0.2126, 0.7152, 0.0722)));
    int row = display.topFirst != 0u ? pixel.y : size.y - 1 - pixel.y;
    imageStore(displayImage, ivec2(pixel.x, row), vec4(color, 1.0));
}
