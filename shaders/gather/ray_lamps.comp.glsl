#version 450 core
// SPDX-License-Identifier: MIT
// G-buffer -> light of lamps that are drawn by chance (lib/lamp_tree.glsl), averaged with the passes and frames before
// (lib/temporal.glsl). What is kept is the radiance to the eye over the part of even light that the surface reflects, so
// that filters keep textures sharp: the light that a white surface would show.
// COUNT_LOOKUPS 1: adds what rays look up to the counters, as those of occlusion.
#define NEAR_TRIANGLES 1
#define BLOCKING_TRIANGLES 1
#include "lib/brdf.glsl"
#include "lib/dot.glsl"
#include "lib/frame_block.glsl"
// For rays and glass, before them.
#include "lib/scene_tables.glsl"
#include "lib/surface_array.glsl"
// The others.
#include "lib/lamp_tree.glsl"
#include "lib/temporal.glsl"
layout(local_size_x = 8, local_size_y = 8) in;
layout(rgba32ui) writeonly uniform uimage2D result;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy) + ivec2(pixelRays.lowestX, pixelRays.lowestY);
    Surface s;
    bool seen = fetchSurface(min(pixel, imageSize(result) - 1), s) && !s.unlit;
    Brdf b = makeBrdf(s.albedo, s.metallic, s.roughness, s.dielectricF0, dot(s.normal, s.toEye));
    b.diffuse *= s.normalMean;
    Receiver receiver = Receiver(litPosition(s), s.normal, s.geometricNormal, s.toEye, vec2(0.0));
    // Towards the eye as well: a pixel in a corner lies on both walls, or behind one of them by rounding.
    float height = max(kStartVoxels * grid.voxelSize, kStartDepth * s.depth);
    vec3 start = s.position + height * (s.geometricNormal + s.toEye);
    uint seed = randomHash(uint(pixel.x) | uint(pixel.y) << 16);
    DirectLight light = lampLight(true, receiver, b, start, LampDraw(seed, pixelRays.pass, seen));
    vec3 radiance = b.diffuse / kPi * light.irradiance + light.specular;
    vec3 value = radiance / max(b.diffuse + b.albedo, vec3(1e-6));
#if COUNT_LOOKUPS
    addLookups(LOOKUPS_OCCLUSION, seen);
#endif
    if (any(greaterThanEqual(pixel, imageSize(result)))) return;
    imageStore(result, pixel,
               withPass(valueSoFar(pixel, s), s, seen, seen ? value : vec3(0.0), pixelRays.shortestMean));
}
