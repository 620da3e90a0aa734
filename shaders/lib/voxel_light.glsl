// SPDX-License-Identifier: MIT
// The light of voxel faces as rays see it, and the estimator of irradiance that the cache's update and the
// pixels share: docs/theory/4_gather.md, "Rays to bright faces".
//
// EXACT_DIRECT 1: light of point, spot and directional lights is looked up at the exact hit point by shadow
// map, not taken from the face; rectangles and emission stay the face's. light::hitLightDefines says for a
// scene. RAY_BACK_FACES as in lib/ray_query.glsl.
//
// Before the call: SurfaceVoxels::bind, OctantWords::bind, IrradianceCache::bind, the frame block;
// EXACT_DIRECT also the scene's tables and the shadow maps.
#ifndef EXACT_DIRECT
#define EXACT_DIRECT 0
#endif
#include "lib/random.glsl"
#include "lib/ray_query.glsl"
#include "lib/record_face.glsl"
#include "lib/scene_tables.glsl"
#include "shared/irradiance.h"
#if EXACT_DIRECT
#if LIGHTS_RECT
#error rectangles are not looked up at hits: LIGHTS_RECT must be 0
#endif
#include "lib/lights.glsl"
#endif
layout(binding = UNIT_STEADY_LIGHT) uniform usamplerBuffer steadyLight;
layout(binding = UNIT_BRIGHT_FACES) uniform usamplerBuffer brightFaces;

const float kGatherPi = 3.14159265358979;

struct FaceShade {
    vec3 albedo;
    vec3 radiance;    // emission and reflected direct light, W/(sr m^2)
    vec3 irradiance;  // cached indirect irradiance / pi
    bool usable;      // false: never updated, or inside a closed object
};

FaceShade faceShade(int face) {
    uvec4 r = texelFetch(voxelFaces, 2 * face + 1);
    vec2 high = unpackHalf2x16(r.w);
    uint updates = r.w >> 16;
    return FaceShade(unpackAlbedo(r.x), unpackRgb9e5(r.y), vec3(unpackHalf2x16(r.z), high.x),
                     updates != 0u && updates < IRRADIANCE_DEAD);
}

// What a face shows: emission, reflected direct light, reflected cached light.
vec3 faceRadiance(int face) {
    FaceShade s = faceShade(face);
    return s.radiance + s.albedo * s.irradiance;
}

// How bright a face is when rays to bright faces are dealt out. The plain mean: blue light counts as much.
float faceBrightness(vec3 radiance) { return dot(radiance, vec3(1.0 / 3.0)); }

// Radiance at a hit; the sky where nothing was met, nothing where a surface was met from behind.
vec3 hitRadiance(VoxelHit hit, vec3 origin, vec3 direction) {
    int face = max(hit.face, 0);
    FaceShade s = faceShade(face);
#if EXACT_DIRECT
    uvec4 r = texelFetch(voxelFaces, 2 * face);
    vec3 normal = octDecode(unpackSnorm2x16(r.x));
    vec3 at = origin + (hit.face >= 0 ? hit.t : 0.0) * direction;
    vec3 position = worldFromGrid(at + faceRise(r, normal));
    vec3 direct = directIrradiance(position, normal, normal) * (1.0 / kGatherPi);
    vec3 radiance = unpackRgb9e5(texelFetch(steadyLight, face).x) + s.albedo * (direct + s.irradiance);
#else
    vec3 radiance = s.radiance + s.albedo * s.irradiance;
#endif
    vec3 missed = hit.backFirst ? vec3(0.0) : frame.sky;
    return hit.face >= 0 ? radiance : missed;
}

// Unit vectors that with `n` form a right-handed frame (Duff et al. 2017, "Building an Orthonormal Basis,
// Revisited").
void tangentFrame(vec3 n, out vec3 u, out vec3 v) {
    float s = n.z >= 0.0 ? 1.0 : -1.0;
    float a = -1.0 / (s + n.z);
    float b = n.x * n.y * a;
    u = vec3(1.0 + s * n.x * n.x * a, s * b, -s * n.x);
    v = vec3(b, s + n.y * n.y * a, -n.y);
}

// Direction with density cos / pi about n (Malley's method).
vec3 cosineDirection(vec3 n, vec2 xi) {
    vec3 u, v;
    tangentFrame(n, u, v);
    float r = sqrt(xi.x);
    float phi = 2.0 * kGatherPi * xi.y;
    return r * cos(phi) * u + r * sin(phi) * v + sqrt(max(1.0 - xi.x, 0.0)) * n;
}

// A random point on a random bright face, in grid coordinates: face with probability ~ brightness x (area of
// its bounds seen along its direction) x (n.k), point uniform in those bounds, moved along the direction onto
// the plane. Summed over the directions of one surface that is a density of brightness / flux per area, since
// the (n.k)^2 add up to 1. Returns false where that point is not in the bounds.
bool sampleBrightFace(inout uint state, out vec3 point, out vec3 normal) {
    uint header = texelFetch(brightFaces, 0).x;
    int entry = int(randomNext(state) * float(BRIGHT_FACE_COUNT));
    uvec4 r = texelFetch(voxelFaces, 2 * int(texelFetch(brightFaces, 1 + entry).x));
    int axis = int(r.w >> 30);
    normal = octDecode(unpackSnorm2x16(r.x));
    vec3 lower = unpackBoundsMin(r.z);
    vec3 upper = unpackBoundsMax(r.z);
    vec2 xi = vec2(randomNext(state), randomNext(state));
    vec3 k = vec3(axis == 0, axis == 1, axis == 2);
    vec3 in01 = axis == 0 ? vec3(0.5, xi) : (axis == 1 ? vec3(xi.y, 0.5, xi.x) : vec3(xi, 0.5));
    vec3 p = mix(lower, upper, in01) * (1.0 - k) + 0.5 * k;
    float along = (unpackOffset(r.y) - dot(normal, p - 0.5)) / dot(normal, k);
    p += along * k;
    point = vec3(unpackVoxel(r.w)) + p;
    float height = dot(p, k);
    // Not beyond the voxel, where its neighbour has the same surface: points there would be drawn twice.
    vec2 range = vec2(max(dot(lower, k) - 1e-3, -1e-4), min(dot(upper, k) + 1e-3, 1.0001));
    return header != 0u && height >= range.x && height <= range.y;
}

// Radiance of a white Lambert surface (irradiance / pi): `cosineRays` by the cosine about the shading normal,
// `lightRays` to bright faces, weighted by the balance heuristic (Veach and Guibas 1995). A miss is the sky.
// A ray to a bright face counts only where it arrives at its point: else directions with many bright faces
// behind an occluder would be counted twice. `index` numbers the calls with the same seed, 0, 1, 2 ...: their
// directions complement each other. backShare: share of cosine rays that met a surface from behind.
vec3 gatherIrradianceSequence(vec3 originGrid, vec3 geometricNormal, vec3 shadingNormal, int cosineRays,
                              int lightRays, uint seed, uint index, out float backShare) {
    float inverseFlux = uintBitsToFloat(texelFetch(brightFaces, 0).x);
    uint state = randomHash(seed) ^ randomHash(index * 0x9e3779b9u + 0x85ebca6bu);
    vec3 sum = vec3(0.0);
    float backs = 0.0;
    int count = cosineRays + lightRays;
    int i = 0;
    do {
        bool toLight = i >= cosineRays;
        vec3 target, targetNormal;
        bool onFace = sampleBrightFace(state, target, targetNormal);
        vec3 toTarget = target - originGrid;
        float distance = length(toTarget);
        vec2 xi = sequencePoint(seed, index * uint(cosineRays) + uint(i));
        vec3 direction = toLight ? toTarget / max(distance, 1e-6) : cosineDirection(shadingNormal, xi);
        float cosine = dot(direction, shadingNormal);
        bool above = cosine > 0.0 && dot(direction, geometricNormal) > 0.0;
        above = above && (!toLight || (onFace && dot(direction, targetNormal) < 0.0 && inverseFlux > 0.0));
        // What lies beyond the point is of no interest.
        float reach = toLight ? distance + 1.0 : 1e9;
        VoxelHit hit = traceVoxels(originGrid, direction, above ? reach : -1.0);
        bool arrived = !toLight || (hit.face >= 0 && abs(hit.t - distance) < 0.3);
        vec3 n = octDecode(unpackSnorm2x16(texelFetch(voxelFaces, 2 * max(hit.face, 0)).x));
        float brightness = hit.face >= 0 ? faceBrightness(faceRadiance(max(hit.face, 0))) : 0.0;
        float turned = max(-dot(n, direction), 1e-3);
        float lightDensity = brightness * inverseFlux * hit.t * hit.t / turned;
        if (hit.face < 0) lightDensity = 0.0;
        float density = float(cosineRays) * cosine / kGatherPi + float(lightRays) * lightDensity;
        vec3 radiance = hitRadiance(hit, originGrid, direction);
        sum += above && arrived ? radiance * (cosine / kGatherPi / max(density, 1e-12)) : vec3(0.0);
        RECORD_RAY(toLight ? PATH_LIGHT_RAY : PATH_COSINE_RAY, originGrid, direction, hit, 1.0,
                   vec3(cosine / kGatherPi / max(density, 1e-12)), radiance, above && arrived);
        backs += !toLight && hit.backFirst ? 1.0 : 0.0;
    } while (++i < count);
    backShare = backs / float(max(cosineRays, 1));
    return sum;
}

vec3 gatherIrradiance(vec3 originGrid, vec3 geometricNormal, vec3 shadingNormal, int cosineRays,
                      int lightRays, uint seed, out float backShare) {
    return gatherIrradianceSequence(originGrid, geometricNormal, shadingNormal, cosineRays, lightRays, seed,
                                    0u, backShare);
}
