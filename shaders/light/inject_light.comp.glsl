#version 450 core
// SPDX-License-Identifier: MIT
// Face records: radiance = emission + albedo / pi * irradiance of the lights. One invocation per face.
// KEEP_IRRADIANCE 0: gathered irradiance is cleared. 1: it stays, and what does not come from point, spot and
// directional lights is written once more by itself (cachedDirect of shared/irradiance.h).
// EMISSION_FITS 1: each face shows a part of its emission (emission_fit.comp.glsl).
#ifndef KEEP_IRRADIANCE
#error KEEP_IRRADIANCE must be 0 or 1
#endif
#ifndef EMISSION_FITS
#error EMISSION_FITS must be 0 or 1
#endif
layout(local_size_x = 64) in;  // before linear_index, which asks for it
#include "lib/lights.glsl"
#include "lib/linear_index.glsl"
#include "lib/voxel_grid.glsl"
#include "lib/voxel_record.glsl"
layout(std430) buffer FaceTable { FaceRecord faces[]; };
uniform usamplerBuffer voxelFaceSources;
#if KEEP_IRRADIANCE
layout(std430) writeonly buffer CachedDirect { uint cachedDirect[]; };
#endif
#if EMISSION_FITS
uniform usamplerBuffer emissionParts;
#endif

// Whether a face holds a part of a rectangle of the scene that shines as an area light: it looks the same
// way, lies in its plane and its bounds reach into it. A voxel on the rectangle's edge has emission of it,
// too, which is no emission but the area light's. Voxels round positions to 1/31 voxel, so a quarter voxel is
// ample.
bool isAreaLight(FaceRecord face, vec3 position, vec3 normal) {
    bool found = false;
#if LIGHTS_RECT
    vec3 reach =
        (0.5 * (unpackBoundsMax(face.bounds) - unpackBoundsMin(face.bounds)) + 0.25) * grid.voxelSize;
    uint i = lighting.lightEnds.z;
    if (i < lighting.lightEnds.w) do {
            Light light = lights[i];
            vec3 d = position - light.position;
            vec3 u = normalize(light.halfU), v = normalize(light.halfV);
            // 0.94: the cosine of 20 degrees, coplanar up to the packing of normals.
            bool on = (light.flags & LIGHT_FROM_EMITTER) != 0u && dot(normal, light.direction) > 0.94 &&
                      abs(dot(d, light.direction)) < 0.25 * grid.voxelSize &&
                      abs(dot(d, u)) < length(light.halfU) + dot(abs(u), reach) &&
                      abs(dot(d, v)) < length(light.halfV) + dot(abs(v), reach);
            found = found || on;
        } while (++i < lighting.lightEnds.w);
#endif
    return found;
}

void main() {
    uint index = min(linearIndex(), grid.faceCount - 1u);
    bool inside = linearIndex() < grid.faceCount;
    FaceRecord face = faces[index];
    vec3 normal = faceNormal(face);
    vec3 position = worldFromGrid(faceCenter(face));
    vec3 emission = unpackEmission(texelFetch(voxelFaceSources, int(index)).xy);
    bool areaLight = emission != vec3(0.0) && isAreaLight(face, position, normal);
    if (areaLight) emission = vec3(0.0);
#if EMISSION_FITS
    emission *= uintBitsToFloat(texelFetch(emissionParts, int(index)).x);
#endif
    vec3 reflectance = unpackAlbedo(face.albedo) * (1.0 / 3.14159265358979);
    Receiver receiver = Receiver(position, normal, normal, normal, kShadowVoxelLift);
    Brdf none;
    DirectLight light = DirectLight(vec3(0.0), vec3(0.0));
    addRectLights(light, false, receiver, none);
#if KEEP_IRRADIANCE
    vec3 steady = emission + reflectance * light.irradiance;
#endif
    addPunctualLights(light, false, receiver, none);
    if (!inside) return;
    faces[index].radiance = packRgb9e5(emission + reflectance * light.irradiance);
#if KEEP_IRRADIANCE
    cachedDirect[index] = packRgb9e5(steady);
    faces[index].irradiance1 = (face.irradiance1 & ~FACE_AREA_LIGHT) | (areaLight ? FACE_AREA_LIGHT : 0u);
#else
    faces[index].irradiance0 = 0u;
    faces[index].irradiance1 = 0u;
#endif
}
