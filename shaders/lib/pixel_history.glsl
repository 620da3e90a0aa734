// SPDX-License-Identifier: MIT
// A picture that is gathered over passes and frames, and what is needed to see whether two of its pixels show
// the same surface: one texel of four words, so that reprojection and filter fetch once per tap.
//   x  value r, g as halves
//   y  value b as half; half: standard deviation of the brightness (mean of the channels), of one pass in
//      what is gathered, of what is shown in what the filter has been over
//   z  view depth, 22 bits of a float without its sign; 10 bits: number of passes. 0: nothing there
//   w  normal, octahedral, 2 x 12 bit; lowest 8 bits of the instance
#include "lib/dot.glsl"
#include "lib/octahedral.glsl"

struct PixelHistory {
    vec3 value;
    float deviation;
    float count;
    float depth;
    vec3 normal;
    uint instance;
};

float pixelBrightness(vec3 value) { return dot(value, vec3(1.0 / 3.0)); }

uint packHistoryBlue(float blue, float deviation) {
    return packHalf2x16(vec2(blue, min(deviation, 65000.0)));
}
uvec4 packPixelHistory(PixelHistory h) {
    vec3 v = clamp(h.value, 0.0, 65000.0);  // below the largest half; NaN becomes 0
    ivec2 n = ivec2(round(clamp(octEncode(h.normal), -1.0, 1.0) * 2047.0)) & 0xfff;
    uint depth = (floatBitsToUint(h.depth) + 0x100u) >> 9;
    return uvec4(packHalf2x16(v.rg), packHistoryBlue(v.b, h.deviation),
                 h.depth > 0.0 ? depth << 10 | uint(min(h.count, 1023.0)) : 0u,
                 uint(n.x) << 20 | uint(n.y) << 8 | (h.instance & 0xffu));
}

vec3 pixelHistoryValue(uvec4 bits) { return vec3(unpackHalf2x16(bits.x), unpackHalf2x16(bits.y).x); }
float pixelHistoryDeviation(uvec4 bits) { return unpackHalf2x16(bits.y).y; }
float pixelHistoryCount(uvec4 bits) { return float(bits.z & 0x3ffu); }
float pixelHistoryDepth(uvec4 bits) { return uintBitsToFloat((bits.z & ~0x3ffu) >> 1); }
vec3 pixelHistoryNormal(uvec4 bits) {
    return octDecode(vec2(int(bits.w) >> 20, int(bits.w << 12) >> 20) * (1.0 / 2047.0));
}
uint pixelHistoryInstance(uvec4 bits) { return bits.w & 0xffu; }
