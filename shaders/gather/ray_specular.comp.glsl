#version 450 core
// SPDX-License-Identifier: MIT
// G-buffer -> radiance in the specular lobe over the lobe's directional albedo, by rays along visible normals
// of GGX (Heitz 2018, "Sampling the GGX Distribution of Visible Normals"), averaged with the passes and
// frames before. What a ray meets shows its interpolated cached light, so that mirrors show no voxels.
// TRIANGLE_HITS 1: rays into smooth lobes meet triangles, not plane pieces (lib/triangle_hit.glsl); below the least
// roughness of a lobe they go exactly the mirrored way.
// COUNT_LOOKUPS 1: adds what rays look up to the counters, shadow maps at hits included.
//
// LOBE_LISTED 1: the listed pixels (gather/lobe_select.comp.glsl), by an indirect dispatch of LOBE_GROUPS_X
// groups in x; the others are the caller's to clear. 0: all pixels.
#ifndef LOBE_LISTED
#define LOBE_LISTED 0
#endif
#define SMOOTH_HITS 1
layout(local_size_x = 8, local_size_y = 8) in;
#include "lib/dot.glsl"
#include "lib/frame_block.glsl"
#include "lib/ggx_sample.glsl"
#include "lib/surface_array.glsl"
#define LOBE_LIST_ACCESS readonly
#include "lib/lobe_list.glsl"
#include "lib/temporal.glsl"
#include "lib/voxel_light.glsl"
layout(rgba32ui) writeonly uniform uimage2D result;

// The radius of the solid angle that is a ray's among all that are averaged (Krivanek and Colbert 2008,
// "Real-time Shading with Filtered Importance Sampling"): at the rim of the lobe it is wide.
float skyWidth(Brdf b, Surface s, vec3 direction) {
    float rays = float(pixelRays.rays) * pixelRays.longestMean;
    return inversesqrt(kPi * rays * max(lobePdf(b, s.normal, s.toEye, direction), 1e-6));
}

vec3 reflectedDirection(Brdf b, Surface s, vec2 xi, out vec3 weight) {
    vec3 direction = lobeDirection(b, s.normal, s.toEye, xi, weight);
#if TRIANGLE_HITS
    // An ideal mirror has no lobe; the surface keeps 16 bits of its roughness.
    if (s.roughness < kMinRoughness - 1e-5) direction = reflect(-s.toEye, s.normal);
#endif
    // A bent normal can mirror into the surface, which shows nothing (docs/theory/4f_glossy.md).
    if (dot(direction, s.geometricNormal) <= 0.0) weight = vec3(0.0);
    return direction;
}

// Of a distant eye, voxels: what a ray that meets plane pieces starts above them.
const float kStartMost = 0.05;

// Where a ray starts. One that meets triangles starts on its own line: moved off its surface by part of a voxel, flat
// water would mirror what stands as much higher. A step towards the eye keeps pixels in corners out of the other wall.
vec3 lobeRayOrigin(Surface s, Brdf b, vec3 direction) {
#if TRIANGLE_HITS
    if (b.alpha <= kTriangleAlpha) {
        float towards = dot(direction, s.geometricNormal);
        float most = kStartMost * grid.voxelSize / kStartDepth;
#if NESTED_GRIDS
        most *= voxelEdgeAt(gridFromWorld(s.position));
#endif
        float depth = min(s.depth, most);
        return gridFromWorld(s.position + kStartDepth * depth * s.toEye +
                             startOnLine(towards, depth) * direction);
    }
#endif
    return seenRayOrigin(gridFromWorld(s.position), s.geometricNormal, s.toEye);
}

void main() {
#if LOBE_LISTED
    ivec2 pixel = listedPixel(imageSize(result));
#else
    ivec2 pixel = INVOCATION_PIXEL;
#endif
    Surface s;
    bool seen = fetchSurface(min(pixel, imageSize(result) - 1), s);
    Brdf b = makeBrdf(s.albedo, s.metallic, s.roughness, s.dielectricF0, dot(s.normal, s.toEye));
    bool glossy = hasLobe(s, seen, pixelRays.specularLimit);
    uint seed = randomHash(uint(pixel.x) | uint(pixel.y) << 16) ^ 0x5bd1e995u;
    uint random = randomHash(seed) ^ randomHash(pixelRays.pass * 0x9e3779b9u + 0x85ebca6bu);
    vec3 sum = vec3(0.0);
    int i = 0;
    do {
        vec2 xi = sequencePoint(seed, pixelRays.pass * pixelRays.rays + uint(i));
        vec3 weight;
        vec3 direction = reflectedDirection(b, s, xi, weight);
        bool counts = glossy && weight.r + weight.g + weight.b > 0.0;
        VoxelHit hit;
#if TRIANGLE_HITS
        float pixelAngle = 2.0 * length(frame.viewUp) / float(frame.height);
        // Parallel rays are as wide everywhere.
        float width = pixelAngle * mix(s.depth, 1.0, frame.parallel);
        rayCone = RayCone(b.alpha <= kTriangleAlpha ? width * pixelRays.inverseVoxelSize : -1.0,
                          pixelAngle * (1.0 - frame.parallel) + b.alpha);
#endif
        Ray ray = Ray(lobeRayOrigin(s, b, direction), direction, counts ? 1e9 : -1.0, s.geometricNormal);
        PathSettings path = PathSettings(-1.0, counts ? int(pixelRays.reflections) : 0, b.alpha,
                                         pixelRays.fireflyClamp, skyWidth(b, s, direction));
        vec3 radiance = throughGlass(traceRadiance(ray, path, random, hit), ray, hit);
        sum += weight * radiance;
        COUNT_LOOKUP(hit.face >= 0 ? 2 + EXACT_DIRECT : 0);
        if (glossy)
            RECORD_RAY(PATH_SPECULAR_RAY, ray, hit, 1.0,
                       weight / (float(pixelRays.rays) * max(b.albedo, 1e-6)), radiance, counts);
    } while (++i < int(pixelRays.rays));
    vec3 value = glossy ? sum / (float(pixelRays.rays) * max(b.albedo, 1e-6)) : vec3(0.0);
#if COUNT_LOOKUPS
    addLookups(LOOKUPS_SPECULAR, glossy);
#endif
#ifdef RECORD_STEPS
    RECORD_SURFACE(seen, s);
    // The first pass takes the place of the irradiance.
    if (glossy && recording() && pixelRays.pass == 0u) record.parts[PART_SPECULAR].value = vec3(0.0);
    if (glossy) RECORD_PART(PART_SPECULAR, value, b.albedo);
    return;
#endif
    if (any(greaterThanEqual(pixel, imageSize(result)))) return;
    // What a smooth surface shows moves otherwise than the surface: means are short there.
    bool moved = pixelRays.reuse >= REUSE_REPROJECTED;
    float longest =
        moved ? mix(1.0, pixelRays.longestMean, smoothstep(0.1, 0.5, s.roughness)) : pixelRays.longestMean;
    imageStore(result, pixel, withPass(pixel, s, seen, value, longest));
}
