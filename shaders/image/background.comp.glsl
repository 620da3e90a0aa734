#version 450 core
// SPDX-License-Identifier: MIT
// The environment behind all surfaces: pixels that see none show its picture, sharp, whatever the mode.
#define ENVIRONMENT 1
#include "lib/dot.glsl"
#include "lib/environment.glsl"
#include "lib/gbuffer.glsl"
#include "lib/picture_pass.glsl"
layout(local_size_x = 8, local_size_y = 8) in;
layout(rgba32f) writeonly uniform image2D picture;

void main() {
    ivec2 pixel = passPixel();
    if (any(greaterThanEqual(pixel, imageSize(picture)))) return;
    if (texelFetch(gbufferGeometry, pixel, 0).x != 0u) return;
    // As wide as the pixel; parallel rays see one direction.
    float width = (1.0 - frame.parallel) * frame.footprint * 2.0 * length(frame.viewUp) / float(frame.height);
    imageStore(picture, pixel, vec4(skyRadiance(normalize(pixelRay(pixel)), width), 0.0));
}
