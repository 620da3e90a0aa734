// SPDX-License-Identifier: MIT
// Light sampling of voxel faces (next-event estimation): random numbers -> a point on a light face, and the
// density of that choice (4.11). Faces are drawn by their flux and by where they are (lib/light_cells.glsl). Part of
// lib/voxel_light.glsl.
#include "lib/dot.glsl"
#include "lib/light_cells.glsl"

// What light samples are drawn from at a place. Little, as rays keep it while they walk.
struct LightRow {
    int row;
    float scale;        // shareOfCluster
    float inverseFlux;  // of all faces; 0: nothing sends light
};

LightRow lightRowAt(vec3 point, vec3 normal) {
    int row = cellAt(point, normal, texelFetch(lightSamples, LIGHT_SHIFT_AT).x).row;
    return LightRow(row, uintBitsToFloat(texelFetch(lightSamples, LIGHT_SCALES_AT + row).x),
                    uintBitsToFloat(texelFetch(lightSamples, LIGHT_INVERSE_FLUX_AT).x));
}

// A random entry of the pool of a random cluster of a row: a face, and LIGHT_MOVED. `row`: place in the list of rows. Evenly
// spread numbers are spread over the scene, those of one cluster over its pool.
uint drawLightFace(float xi, uint row) {
    uint slots = texelFetch(lightSamples, LIGHT_SLOT_COUNT_AT).x;
    float place = xi * float(slots);
    uint slot = min(uint(place), slots - 1u);
    uint word = texelFetch(lightSamples, int(uint(LIGHT_SLOTS_AT) + (row * slots + slot) / 2u)).x;
    uint cluster = (slot & 1u) != 0u ? word >> 16 : word & 0xffffu;
    uint pool = texelFetch(lightSamples, int(uint(LIGHT_CLUSTER_POOLS_AT) + cluster)).x;
    uint shift = pool & 15u;
    // Slots of one cluster begin at different parts of its pool, of 32.
    uint part = (11u * (slot >> 3) + 4u * (slot & 7u)) & 31u;
    uint entry = uint((place - float(slot)) * float(1u << shift)) + ((part << shift) >> 5);
    uint at = (pool >> 4) + (entry & ((1u << shift) - 1u));
    return texelFetch(lightSamples, int(uint(LIGHT_POOLS_AT) + at)).x;
}

struct LightSample {
    int face;  // -1: the point misses the face
    vec3 point;
    vec3 normal;
};

// A random point on a random light face, in grid coordinates. xi.x chooses the face, xi.yz choose
// a point, uniform in the face's bounds as seen along its direction k, projected along k onto its plane.
LightSample sampleLightFace(vec3 xi, vec3 origin, LightRow lights) {
    // Choose a face by its flux, and by what its cluster brings to the cell
    uint entry = drawLightFace(xi.x, texelFetch(lightSamples, LIGHT_PLACES_AT + lights.row).x);
    int face = int(entry & ~LIGHT_MOVED);
    uvec4 r = texelFetch(voxelFaces, face);
    int axis = int(r.w >> 30);
    vec3 normal = octDecode(unpackSnorm2x16(r.x));

    // Choose a point within its bounds
    vec3 lower, upper;
    lightSampleBounds(r, normal, origin, (entry & LIGHT_MOVED) != 0u ? -1.0 : 1.0, lower, upper);
    vec3 k = vec3(axis == 0, axis == 1, axis == 2);
    vec3 uvw = axis == 0 ? vec3(0.5, xi.yz) : (axis == 1 ? vec3(xi.z, 0.5, xi.y) : vec3(xi.yz, 0.5));
    vec3 p = mix(lower, upper, uvw) * (1.0 - k) + 0.5 * k;

    // Project it onto the plane
    float height = (unpackOffset(r.y) - dot(normal, p - 0.5)) / dot(normal, k);
    p += height * k;
    float along = dot(p, k);
    bool inside = lights.inverseFlux > 0.0 && along >= dot(lower, k) && along <= dot(upper, k);
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
float lightFacePdf(Ray ray, VoxelHit hit, LightRow lights) {
    uvec4 r = texelFetch(voxelFaces, max(hit.face, 0));
    vec3 n = octDecode(unpackSnorm2x16(r.x));
    float radiance = hit.face >= 0 ? brightness(outgoingRadiance(max(hit.face, 0))) : 0.0;
    float cosine = max(-dot(n, ray.direction), 1e-3);
    float pdf = radiance * dominantFaceShare(n, r.w >> 30) * lights.inverseFlux * hit.t * hit.t / cosine;
#if NESTED_GRIDS
    // Faces have their flux in voxels of their own level: coarse ones are far from the eye.
    vec4 place = voxelPlace(r.w);
    vec3 point = (ray.origin + hit.t * ray.direction - place.xyz) / place.w;
    pdf /= place.w * place.w;
#else
    vec3 point = ray.origin + hit.t * ray.direction - vec3(unpackVoxel(r.w));
#endif
    LightCell cluster = clusterOfFace(r, n),
              cell = cellOfRow(lights.row, texelFetch(lightSamples, LIGHT_SHIFT_AT).x);
    LightBounds sender =
        lightBounds(cluster, texelFetch(lightSamples, LIGHT_CLUSTER_EXTENTS_AT + cluster.row).x);
    LightBounds getter = lightBounds(cell, texelFetch(lightSamples, LIGHT_CELL_EXTENTS_AT + cell.row).x);
    pdf *= shareOfCluster(lightGain(getter, sender), lights.scale);
    return hit.face >= 0 ? pdf * lightSampleShare(r, n, ray.origin, point) : 0.0;
}
