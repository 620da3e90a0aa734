#version 450 core
// SPDX-License-Identifier: MIT
// Component occlusion: the open part of the hemisphere (cone_diffuse with OCCLUSION) as a grey picture, white
// in the background.
#include "lib/gbuffer.glsl"
#include "lib/picture_pass.glsl"
layout(local_size_x = 8, local_size_y = 8) in;
layout(rgba32f) writeonly uniform image2D result;
uniform sampler2D occlusion;

void main() {
    ivec2 pixel = passPixel();
    if (any(greaterThanEqual(pixel, imageSize(result)))) return;
    Surface s;
    bool seen = fetchSurface(pixel, s);
    float open = texelFetch(occlusion, pixel, 0).a;
    imageStore(result, pixel, seen ? vec4(vec3(open), 1.0) : vec4(vec3(1.0), 0.0));
}
