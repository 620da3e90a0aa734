#version 450 core
// SPDX-License-Identifier: MIT
// A level of the low-resolution copy of a texture of the host's, as src/scene/gpu_materials.cpp makes those of others:
// linear, and encoded as an sRGB format keeps it. An invocation per texel.
//   HALVES  0: level 0, the mean of the host's texels or copies of them
//           1: another level, the mean of four of the one before
#ifndef HALVES
#error HALVES must be 0 or 1
#endif
layout(local_size_x = 8, local_size_y = 8) in;
layout(rgba32f) writeonly uniform image2D linearLevel;
layout(r32ui) writeonly uniform uimage2D encodedLevel;
#if HALVES
uniform sampler2D linearLevels;

vec4 meanAt(ivec2 texel, int edge) {
    int level = findMSB(textureSize(linearLevels, 0).x) - findMSB(edge) - 1;
    ivec2 first = 2 * texel;
    return 0.25 *
           (texelFetch(linearLevels, first, level) + texelFetch(linearLevels, first + ivec2(1, 0), level) +
            texelFetch(linearLevels, first + ivec2(0, 1), level) +
            texelFetch(linearLevels, first + 1, level));
}
#else
uniform sampler2D hostTexture;

// In [0, 1]; a texel that is no number is black.
vec4 hostTexel(ivec2 at) {
    vec4 value = texelFetch(hostTexture, at, 0);
    return mix(clamp(value, 0.0, 1.0), vec4(0.0), isnan(value));
}

vec4 meanAt(ivec2 texel, int edge) {
    ivec2 size = textureSize(hostTexture, 0);
    ivec2 low = texel * size / edge;
    ivec2 high = max(low + 1, (texel + 1) * size / edge);
    vec4 sum = vec4(0.0);
    for (int y = low.y; y < high.y; ++y)
        for (int x = low.x; x < high.x; ++x) sum += hostTexel(ivec2(x, y));
    ivec2 count = high - low;
    return sum / float(count.x * count.y);
}
#endif

vec3 encoded(vec3 c) {
    return mix(1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, 12.92 * c, lessThanEqual(c, vec3(0.0031308)));
}

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    int edge = imageSize(encodedLevel).x;
    if (max(texel.x, texel.y) >= edge) return;
    vec4 mean = meanAt(texel, edge);
    imageStore(linearLevel, texel, mean);
    imageStore(encodedLevel, texel, uvec4(packUnorm4x8(vec4(encoded(mean.rgb), mean.a))));
}
