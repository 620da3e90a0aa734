#version 450 core
// SPDX-License-Identifier: MIT
// Component occlusion: the open part of the hemisphere (ray_diffuse with OCCLUSION) as a grey picture, white
// in the background.
#include "lib/picture_pass.glsl"
#include "lib/pixel_history.glsl"
#include "shared/pixel_rays.h"
layout(local_size_x = 8, local_size_y = 8) in;
uniform usampler2D occlusion;
layout(rgba32f) writeonly uniform image2D result;

void main() {
    ivec2 pixel = passPixel();
    if (any(greaterThanEqual(pixel, imageSize(result)))) return;
    uvec4 bits = texelFetch(occlusion, pixel, 0);
    bool seen = bits.z != 0u;
    imageStore(result, pixel, vec4(seen ? pixelHistoryValue(bits) : vec3(1.0), seen ? 1.0 : 0.0));
}
