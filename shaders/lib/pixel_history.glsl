// SPDX-License-Identifier: MIT
// A picture that is gathered over passes and frames, and what is needed to see whether two of its pixels show
// the same surface: one texel of four words, so that reprojection and filter fetch once per tap.
//   x  value r, g as halves
//   y  value b as half; number of passes behind it in the upper half
//   z  view depth, float bits; 0: nothing there
//   w  normal, octahedral, 2 x 12 bit; lowest 8 bits of the instance
#include "lib/octahedral.glsl"

struct PixelHistory {
    vec3 value;
    float count;
    float depth;
    vec3 normal;
    uint instance;
};

uvec4 packPixelHistory(PixelHistory h) {
    vec3 v = clamp(h.value, 0.0, 65000.0);  // below the largest half; NaN becomes 0
    ivec2 n = ivec2(round(clamp(octEncode(h.normal), -1.0, 1.0) * 2047.0)) & 0xfff;
    return uvec4(packHalf2x16(v.rg), packHalf2x16(vec2(v.b, 0.0)) | (uint(min(h.count, 65535.0)) << 16),
                 floatBitsToUint(h.depth), uint(n.x) << 20 | uint(n.y) << 8 | (h.instance & 0xffu));
}

vec3 pixelHistoryValue(uvec4 bits) { return vec3(unpackHalf2x16(bits.x), unpackHalf2x16(bits.y).x); }
float pixelHistoryCount(uvec4 bits) { return float(bits.y >> 16); }
float pixelHistoryDepth(uvec4 bits) { return uintBitsToFloat(bits.z); }
vec3 pixelHistoryNormal(uvec4 bits) {
    return octDecode(vec2(int(bits.w) >> 20, int(bits.w << 12) >> 20) * (1.0 / 2047.0));
}
uint pixelHistoryInstance(uvec4 bits) { return bits.w & 0xffu; }
