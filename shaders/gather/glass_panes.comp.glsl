#version 450 core
// SPDX-License-Identifier: MIT
// Glass in front of a finished picture, for modes without rays: all of it lets through straight on, tinted, and
// reflects lights alone. Pixels that see none stay as they are. By rays: gather/glass_rays.comp.glsl.
layout(local_size_x = 8, local_size_y = 8) in;
#include "lib/frame_block.glsl"
#include "lib/picture_pass.glsl"
// For glass, before the others.
#include "lib/scene_tables.glsl"
#include "lib/surface_array.glsl"
// The others.
#include "lib/glass_sight.glsl"
#include "lib/glass_tree.glsl"
#include "lib/lighting.glsl"
#include "lib/lights.glsl"
layout(std140) uniform GlassBlock { GlassConstants glassPass; };
layout(rgba32f) uniform image2D picture;

const int kMostGlass = 32;  // surfaces in the line of sight

void main() {
    ivec2 pixel = passPixel();
    if (any(greaterThanEqual(pixel, imageSize(picture)))) return;
    GlassSight sight = glassSight(pixel);
    GlassHit hit = nearestGlass(sight.origin, sight.direction, sight.end, -1, true);
    if (hit.triangle < 0) return;
    vec3 origin = sight.origin;
    vec3 left = vec3(1.0), light = vec3(0.0), absorption = vec3(0.0);
    int met = 0;
    do {
        GlassSurface s = glassSurface(origin, sight.direction, hit);
        left *= exp(-absorption * hit.t);
        sight.end -= hit.t;
        Receiver receiver = Receiver(s.position, s.normal, s.geometricNormal, -sight.direction, vec2(0.0));
        bool shines = glassPass.direct != 0u && !(s.back && s.solid);
        vec3 highlight = shines ? directLight(receiver, s.brdf).specular : vec3(0.0);
        light += left * (highlight + s.emission * float(glassPass.direct));
        left *= s.back && s.solid ? s.tint : s.through;
        absorption = s.solid && !s.back ? s.absorption : vec3(0.0);
        origin = glassStep(s.position, -s.geometricNormal);
        hit = nearestGlass(origin, sight.direction, sight.end, hit.triangle, true);
    } while (hit.triangle >= 0 && ++met < kMostGlass);
    imageStore(picture, pixel, vec4(light + left * imageLoad(picture, pixel).rgb, 1.0));
}
