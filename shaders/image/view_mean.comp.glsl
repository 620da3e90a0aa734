#version 450 core
// SPDX-License-Identifier: MIT
// One more view into the mean of them: linear radiance and coverage of each pixel.
#include "lib/picture_pass.glsl"
#include "shared/image.h"
layout(local_size_x = 8, local_size_y = 8) in;
layout(std140) uniform ViewMeanBlock { ViewMeanConstants viewMean; };
uniform sampler2D view;
layout(rgba32f) uniform image2D mean;

void main() {
    ivec2 pixel = passPixel();
    if (any(greaterThanEqual(pixel, imageSize(mean)))) return;
    vec4 value = texelFetch(view, pixel, 0);
    // The first view takes the place of whatever was there.
    if (viewMean.views > 1u) {
        vec4 before = imageLoad(mean, pixel);
        value = before + (value - before) / float(viewMean.views);
    }
    imageStore(mean, pixel, value);
}
