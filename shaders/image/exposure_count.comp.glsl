#version 450 core
// SPDX-License-Identifier: MIT
// Picture -> how many of its pixels have a luminance in each bin (shared/image.h). One invocation per pixel;
// sums of integers, so their order does not show. CPU twin: autoExposure in src/image/tone_map.cpp.
layout(local_size_x = 8, local_size_y = 8) in;
#include "lib/dot.glsl"
#include "shared/image.h"
uniform sampler2D linearImage;
layout(std430) buffer BinCounts { uint counts[]; };
shared uint ofGroup[EXPOSURE_BINS];

void main() {
    uint lane = gl_LocalInvocationIndex;
    for (uint bin = lane; bin < EXPOSURE_BINS; bin += 64u) ofGroup[bin] = 0u;
    barrier();
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (all(lessThan(pixel, textureSize(linearImage, 0)))) {
        float luminance = dot(texelFetch(linearImage, pixel, 0).rgb, vec3(0.2126, 0.7152, 0.0722));
        if (luminance > EXPOSURE_LEAST && luminance < EXPOSURE_MOST)
            atomicAdd(ofGroup[(floatBitsToUint(luminance) >> EXPOSURE_SHIFT) - EXPOSURE_FIRST], 1u);
    }
    barrier();
    for (uint bin = lane; bin < EXPOSURE_BINS; bin += 64u)
        if (ofGroup[bin] != 0u) atomicAdd(counts[bin], ofGroup[bin]);
}
