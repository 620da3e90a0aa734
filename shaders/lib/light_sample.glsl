// SPDX-License-Identifier: MIT
// Light sampling of voxel faces (next-event estimation): random numbers -> a point on a light face, and the
// density of that choice (4.11). Faces are drawn in proportion to their flux from the candidate list that
// light/cache_pool.comp.glsl fills. Part of lib/voxel_light.glsl.
#include "lib/dot.glsl"

// One light sample in this many uses bounds that are moved the other way (lightSampleBounds). Without them
// only cosine-sampled rays would find the rim of a light face that ends at a voxel's side: white dots far
// away from it, because one such ray carries as much as a hundred light-sampled ones. A smaller number wastes
// more rays.
const int kMovedBoundsPeriod = 16;

struct LightSample {
    int face;  // -1: the point misses the face
    vec3 point;
    vec3 normal;
};

// A random point on a random light face, in grid coordinates. xi.x chooses the face: the list is ordered like
// the voxels but for close neighbours, so that evenly spread numbers are spread over the scene. xi.yz choose
// a point, uniform in the face's bounds as seen along its direction k, projected along k onto its plane.
LightSample sampleLightFace(vec3 xi, vec3 origin) {
    // Choose a face by its flux
    uint header = texelFetch(lightSamples, 0).x;
    int entry = int(xi.x * float(LIGHT_SAMPLE_COUNT));
    int face = int(texelFetch(lightSamples, 1 + entry).x);
    uvec4 r = texelFetch(voxelFaces, face);
    int axis = int(r.w >> 30);
    vec3 normal = octDecode(unpackSnorm2x16(r.x));

    // Choose a point within its bounds
    vec3 lower, upper;
    lightSampleBounds(r, normal, origin, entry % kMovedBoundsPeriod == 0 ? -1.0 : 1.0, lower, upper);
    vec3 k = vec3(axis == 0, axis == 1, axis == 2);
    vec3 uvw = axis == 0 ? vec3(0.5, xi.yz) : (axis == 1 ? vec3(xi.z, 0.5, xi.y) : vec3(xi.yz, 0.5));
    vec3 p = mix(lower, upper, uvw) * (1.0 - k) + 0.5 * k;

    // Project it onto the plane
    float height = (unpackOffset(r.y) - dot(normal, p - 0.5)) / dot(normal, k);
    p += height * k;
    float along = dot(p, k);
    bool inside = header != 0u && along >= dot(lower, k) && along <= dot(upper, k);
#if NESTED_GRIDS
    vec4 place = voxelPlace(r.w);
    return LightSample(inside ? face : -1, place.xyz + place.w * p, normal);
#else
    return LightSample(inside ? face : -1, vec3(unpackVoxel(r.w)) + p, normal);
#endif
}

// Share of the light samples of a face whose bounds hold a point (relative to the voxel).
float lightSampleShare(uvec4 hitTexel, vec3 n, vec3 origin, vec3 point) {
    const float moved = 1.0 / float(kMovedBoundsPeriod);
    vec3 lower, upper;
    lightSampleBounds(hitTexel, n, origin, 1.0, lower, upper);
    bool inBounds = all(greaterThanEqual(point, lower)) && all(lessThanEqual(point, upper));
    lightSampleBounds(hitTexel, n, origin, -1.0, lower, upper);
    bool inMoved = all(greaterThanEqual(point, lower)) && all(lessThanEqual(point, upper));
    return (inBounds ? 1.0 - moved : 0.0) + (inMoved ? moved : 0.0);
}

// Density per steradian with which sampleLightFace chooses the ray's direction, given what the ray hit
// (4.11).
float lightFacePdf(Ray ray, VoxelHit hit, float inverseFlux) {
    uvec4 r = texelFetch(voxelFaces, max(hit.face, 0));
    vec3 n = octDecode(unpackSnorm2x16(r.x));
    float radiance = hit.face >= 0 ? brightness(outgoingRadiance(max(hit.face, 0))) : 0.0;
    float cosine = max(-dot(n, ray.direction), 1e-3);
    float pdf = radiance * dominantFaceShare(n, r.w >> 30) * inverseFlux * hit.t * hit.t / cosine;
#if NESTED_GRIDS
    // Faces have their flux in voxels of their own level: coarse ones are far from the eye.
    vec4 place = voxelPlace(r.w);
    vec3 point = (ray.origin + hit.t * ray.direction - place.xyz) / place.w;
    pdf /= place.w * place.w;
#else
    vec3 point = ray.origin + hit.t * ray.direction - vec3(unpackVoxel(r.w));
#endif
    return hit.face >= 0 ? pdf * lightSampleShare(r, n, ray.origin, point) : 0.0;
}
