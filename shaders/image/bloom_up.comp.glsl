#version 450 core
// SPDX-License-Identifier: MIT
// The light that spreads, from coarse to fine: a level's part of it, and all of the coarser levels. GPU twin
// of src/image/bloom.cpp.
#include "image/bloom_tent.glsl"
#include "shared/image.h"
layout(local_size_x = 8, local_size_y = 8) in;
layout(std140) uniform BloomBlock { BloomConstants bloom; };
uniform sampler2D from;  // its level fromLevel is the next coarser one
layout(rgba32f) uniform image2D level;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(level)))) return;
    vec3 sum = bloom.weight * imageLoad(level, pixel).rgb;
    if (bloom.coarser > 0.0) sum += bloomTent(from, int(bloom.fromLevel), pixel);
    imageStore(level, pixel, vec4(sum, 1.0));
}
