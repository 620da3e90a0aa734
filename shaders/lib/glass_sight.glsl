// SPDX-License-Identifier: MIT
// What a pixel sees through glass: from where, its direction, and how far it is to what the picture shows.
#include "lib/dot.glsl"
#include "lib/gbuffer.glsl"

struct GlassSight {
    vec3 origin;
    vec3 direction;  // unit
    float end;       // m
};

GlassSight glassSight(ivec2 pixel) {
    vec3 ray = pixelRay(pixel);
    float along = length(ray);
    float depth = uintBitsToFloat(texelFetch(gbufferGeometry, pixel, 0).x);
    // Just before the surface: what lies on it is drawn with it.
    return GlassSight(pixelOrigin(pixel), ray / along, depth > 0.0 ? depth * along * 0.99999 : 1e9);
}
