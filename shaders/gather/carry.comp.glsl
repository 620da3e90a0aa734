#version 450 core
// SPDX-License-Identifier: MIT
// A gathered picture, filtered, as a view sees it that lies a part of a pixel beside its own: for stills
// that are anti-aliased (docs/theory/5_image.md, "Edges"). Each surface of this view takes what the pixels
// about it were gathered for, where those show the same surface (lib/temporal.glsl). Things that no pixel of the gathered
// picture shows, wires for example, take the nearest of nine that shows their instance, else the cache.
//   LOBES 1: a picture of lobes, in a rectangle from pixelRays.lowestX, lowestY
//   CACHED 0: a picture of lamps, of which the cache knows nothing
#if !defined(LOBES) || !defined(CACHED)
#error LOBES and CACHED must be 0 or 1
#endif
#define MOTION 0
#if CACHED
#include "lib/cache_lookup.glsl"
#endif
#include "lib/dot.glsl"
#include "lib/lookup_count.glsl"
#include "lib/record_steps.glsl"
#include "lib/temporal.glsl"
layout(local_size_x = 8, local_size_y = 8) in;
layout(rgba32ui) writeonly uniform uimage2D result;

// Of the pixels about it, the one of its instance whose normal is most like its own; a: whether there is one.
vec4 likestNear(ivec2 pixel, Surface s) {
    ivec2 size = textureSize(pixelHistory, 0);
    ivec2 middle = pixel * size / imageSize(result);  // where the pictures differ in size
    vec4 found = vec4(0.0);
    float likest = 0.0;  // turned by less than a right angle
    for (int i = 0; i < 9; ++i) {
        ivec2 q = clamp(middle + ivec2(i % 3, i / 3) - 1, ivec2(0), size - 1);
        uvec4 bits = texelFetch(pixelHistory, q, 0);
        float alike = dot(pixelHistoryNormal(bits), s.normal);
        bool better = bits.z != 0u && pixelHistoryInstance(bits) == (s.instance & 0xffu) && alike > likest;
        found = better ? vec4(pixelHistoryValue(bits), 1.0) : found;
        likest = better ? alike : likest;
    }
    return found;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
#if LOBES
    pixel += ivec2(pixelRays.lowestX, pixelRays.lowestY);
#endif
    ivec2 size = imageSize(result);
    Surface s;
    bool wanted = fetchSurface(min(pixel, size - 1), s) && !s.unlit;
#if LOBES
    wanted = wanted && s.roughness <= pixelRays.specularLimit;
#endif
    vec4 carried = valueSoFar(min(pixel, size - 1), s).value;
    vec3 value = carried.rgb;
    // A loop, as software drivers take both ways of a branch, but leave loops out that no pixel of a group needs.
    bool lost = wanted && carried.a <= 0.0;
    while (lost) {
        vec4 near = likestNear(pixel, s);
        vec3 cached = vec3(0.0);
#if CACHED
        cached = cachedIrradiance(gridFromWorld(s.position), s.normal, near.a == 0.0).rgb;
#endif
        value = near.a > 0.0 ? near.rgb : cached;
        lost = false;
    }
    if (any(greaterThanEqual(pixel, size))) return;
    imageStore(result, pixel,
               packPixelHistory(PixelHistory(value, 0.0, 1.0, wanted ? s.depth : 0.0, s.normal, s.instance)));
}
