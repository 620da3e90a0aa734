#version 450 core
// SPDX-License-Identifier: MIT
// G-buffer -> irradiance / pi by rays through the voxels (lib/voxel_light.glsl), averaged with the passes and
// frames before (lib/temporal.glsl). The surface's colour is left out, so that filters keep textures sharp.
// NEAR_TRIANGLES 1: rays meet triangles within a voxel of their start (lib/ray_query.glsl).
// OCCLUSION 1: instead the open part of the hemisphere; surfaces count less the farther they are.
// COUNT_LOOKUPS 1: adds what rays look up to the counters, shadow maps at hits included.
#define PIXEL_SHIFTS 1
#ifndef OCCLUSION
#error OCCLUSION must be 0 or 1
#endif
#include "lib/brdf.glsl"
#include "lib/dot.glsl"
#include "lib/frame_block.glsl"
#include "lib/loops.glsl"
#include "lib/pixel_shift.glsl"
#include "lib/scene_tables.glsl"
#include "lib/surface_array.glsl"
#include "lib/temporal.glsl"
#include "lib/voxel_light.glsl"
layout(local_size_x = 8, local_size_y = 8) in;
layout(rgba32ui) writeonly uniform uimage2D result;

#if OCCLUSION
// Ambient openness: mean over cosine-sampled rays of their distance over the reach; 1 for a miss.
float openness(vec3 origin, vec3 shadingNormal, vec3 geometricNormal, vec2 shift) {
    float sum = 0.0;
    int i = 0;
    do {
        vec2 xi = fract(sequencePoint(kPixelSequence, pixelRays.pass * pixelRays.rays + uint(i)) + shift);
        Ray ray = Ray(origin, cosineDirection(shadingNormal, xi), pixelRays.reach, geometricNormal);
        VoxelHit hit = traceVoxels(ray);
        float open = hit.face >= 0 ? hit.t / pixelRays.reach : 1.0;
        sum += open;
        RECORD_RAY(PATH_OCCLUSION_RAY, ray, hit, 1.0 - open, vec3(1.0 / float(pixelRays.rays)), vec3(open),
                   true);
    } while (++i < int(pixelRays.rays));
    return sum / float(pixelRays.rays);
}
#endif

void main() {
#ifdef RECORD_STEPS
    ivec2 pixel = INVOCATION_PIXEL;
#else
    ivec2 pixel = interleavedPixel() + ivec2(pixelRays.lowestX, pixelRays.lowestY);
#endif
    Surface s;
    bool seen = fetchSurface(min(pixel, imageSize(result) - 1), s);
    bool diffuse = seen && !s.unlit && (s.metallic < 1.0 || s.roughness > pixelRays.specularLimit);
    RECORD_PATHS(diffuse);
    // Pixels without need of it send rays out of the grid, which end at once.
    const vec3 away = vec3(-1.0, 0.0, 0.0);
    vec3 normal = diffuse ? s.normal : away;
#if NESTED_GRIDS
    vec3 outside = levelPlace(coarsestLevel()).xyz + 16.0 * away;
#else
    vec3 outside = 16.0 * away;
#endif
    vec3 origin = diffuse ? seenRayOrigin(gridFromWorld(s.position), s.geometricNormal, s.toEye) : outside;
    uint seed = randomHash(uint(pixel.x) | uint(pixel.y) << 16);
    uint shift = pixelShift(uvec2(pixel), seed);
#if OCCLUSION
    vec3 value = vec3(openness(origin, normal, s.geometricNormal, unpackShift(shift).xy));
#else
    SurfacePoint point = SurfacePoint(origin, diffuse ? s.geometricNormal : away, normal);
    EstimatorSettings settings = EstimatorSettings(int(pixelRays.rays), int(pixelRays.rays),
                                                   int(pixelRays.reflections), pixelRays.fireflyClamp);
    float backFaceShare;
    SequenceState sequence = SequenceState(kPixelSequence, pixelRays.pass, shift, seed);
    vec3 value = estimateIrradiance(point, settings, sequence, backFaceShare);
#endif
#if COUNT_LOOKUPS
    addLookups(OCCLUSION == 1 ? LOOKUPS_OCCLUSION : LOOKUPS_DIFFUSE, diffuse);
#endif
#ifdef RECORD_STEPS
    Brdf b = makeBrdf(s.albedo, s.metallic, s.roughness, s.dielectricF0, dot(s.normal, s.toEye));
    RECORD_SURFACE(seen, s);
    RECORD_PART(OCCLUSION == 1 ? PART_OCCLUSION : PART_DIFFUSE, diffuse ? value : vec3(0.0),
                OCCLUSION == 1 ? vec3(1.0) : b.diffuse);
#if !OCCLUSION
    // Unless the pixel has rays of its own into the lobe, which are recorded after this.
    RECORD_PART(PART_SPECULAR, diffuse ? value : vec3(0.0), b.albedo);
#endif
    return;
#endif
    if (any(greaterThanEqual(pixel, imageSize(result)))) return;
    SoFar soFar = valueSoFar(pixel, s);
#if OCCLUSION
    float changed = 0.0;
#else
    float changed = scaledToNow(soFar, s.position);
#endif
    float longest = longestMeanAt(s.position, changed);
    imageStore(result, pixel, withPass(soFar, s, seen, diffuse ? value : vec3(0.0), longest));
}
