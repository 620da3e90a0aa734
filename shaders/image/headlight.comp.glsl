#version 450 core
// SPDX-License-Identifier: MIT
// Light from the eye, added to a picture: each surface scatters evenly what arrives, the lobe's part too, so that
// metals are seen and nothing glares.
#include "lib/brdf.glsl"
#include "lib/dot.glsl"
#include "lib/gbuffer.glsl"
#include "lib/picture_pass.glsl"
#include "shared/image.h"
layout(local_size_x = 8, local_size_y = 8) in;
layout(std140) uniform HeadlightBlock { HeadlightConstants headlight; };
layout(rgba32f) uniform image2D picture;

void main() {
    ivec2 pixel = passPixel();
    if (any(greaterThanEqual(pixel, imageSize(picture)))) return;
    Surface s;
    if (!fetchSurface(pixel, s) || s.unlit) return;
    float NoV = max(dot(s.normal, s.toEye), 0.0);
    Brdf b = makeBrdf(s.albedo, s.metallic, s.roughness, s.dielectricF0, NoV);
    vec3 added = (b.diffuse + b.albedo) / kPi * (NoV * headlight.irradiance);
    imageStore(picture, pixel, imageLoad(picture, pixel) + vec4(added, 0.0));
}
