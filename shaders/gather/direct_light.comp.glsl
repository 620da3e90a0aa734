#version 450 core
// SPDX-License-Identifier: MIT
// G-buffer + lights -> the light that reaches the eye without a bounce, per pixel: `diffuse` holds what the
// diffuse part reflects plus emission (background: the sky), `specular` what the specular lobe reflects.
// a: 1 where there is a surface, 0 in the background. CONE_SHADOWS 1: with the defines of lib/cone_trace.glsl.
#include "lib/dot.glsl"
#include "lib/gbuffer.glsl"
#include "lib/picture_pass.glsl"
// For glass, before the others.
#include "lib/scene_tables.glsl"
#include "lib/surface_array.glsl"
// The others.
#include "lib/lights.glsl"
// After all that include what it includes.
#if CONE_SHADOWS
#include "lib/cone_shadow.glsl"
#endif

layout(local_size_x = 8, local_size_y = 8) in;
layout(rgba32f) writeonly uniform image2D diffuseImage;
layout(rgba32f) writeonly uniform image2D specularImage;

void main() {
    ivec2 pixel = passPixel();
    Surface s;
    bool seen = fetchSurface(pixel, s);
    Brdf b = makeBrdf(s.albedo, s.metallic, s.roughness, s.dielectricF0, dot(s.normal, s.toEye));
    DirectLight light =
        directLight(Receiver(litPosition(s), s.normal, s.geometricNormal, s.toEye, vec2(0.0)), b);
    vec3 diffuse = b.diffuse / kPi * (s.normalMean * light.irradiance) + s.emission;
    vec3 specular = s.unlit ? vec3(0.0) : light.specular;
    if (pixel.x >= int(frame.width) || pixel.y >= int(frame.height)) return;
    imageStore(diffuseImage, pixel, seen ? vec4(diffuse, 1.0) : vec4(lighting.sky, 0.0));
    imageStore(specularImage, pixel, seen ? vec4(specular, 1.0) : vec4(0.0));
}
