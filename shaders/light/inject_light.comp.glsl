#version 450 core
// SPDX-License-Identifier: MIT
// Lit faces: radiance = emission + albedo / pi * irradiance of the lights; no indirect irradiance. One
// invocation per face.
// FOR_RAYS 1: what does not come from point, spot and directional lights is written once more by itself
// (cachedDirect of shared/irradiance.h), and faces know their lobes and area lights.
// EMISSION_FITS 1: each face shows a part of its emission (emission_fit.comp.glsl).
#ifndef FOR_RAYS
#error FOR_RAYS must be 0 or 1
#endif
#ifndef EMISSION_FITS
#error EMISSION_FITS must be 0 or 1
#endif
layout(local_size_x = 64) in;  // before linear_index, which asks for it
// For glass, before the others.
#include "lib/dot.glsl"
#include "lib/scene_tables.glsl"
#include "lib/surface_array.glsl"
// The others.
#include "lib/lights.glsl"
#include "lib/linear_index.glsl"
#include "lib/voxel_grid.glsl"
#include "lib/voxel_record.glsl"
#include "shared/irradiance.h"
layout(std430) readonly buffer FaceTable { FaceRecord faces[]; };
layout(std430) writeonly buffer LitFaceTable { LitFace litFaces[]; };
uniform usamplerBuffer voxelFaceMaterials;
#if FOR_RAYS
layout(std430) writeonly buffer CachedDirect { uint cachedDirect[]; };
#endif
#if EMISSION_FITS
uniform usamplerBuffer emissionParts;
#endif

// Whether a face holds a part of something of the scene that shines as an area light. Of a sphere or a box: its voxel may
// meet it. Of a rectangle: it looks the same way, lies in its plane and its bounds reach into it. A voxel on the rectangle's
// edge has emission of it, too, which is no emission but the area light's. Voxels round positions to 1/31 voxel, so a quarter
// voxel is ample.
bool isAreaLight(FaceRecord face, vec3 position, vec3 normal, float voxelSize) {
    bool found = false;
#if LIGHTS_RECT
    vec3 bounds = (0.5 * (unpackBoundsMax(face.bounds) - unpackBoundsMin(face.bounds)) + 0.25) * voxelSize;
    uint i = lighting.lightEnds.z;
    if (i < lighting.lightEnds.w) do {
            Light light = lightOfTable(i);
            vec3 d = position - light.position;
            vec3 u = normalize(light.halfU), v = normalize(light.halfV);
            // 0.94: the cosine of 20 degrees, coplanar up to the packing of normals.
            bool side = (light.flags & LIGHT_SIDE) != 0u;
            bool facing =
                dot(normal, light.direction) > 0.94 && abs(dot(d, light.direction)) < 0.25 * voxelSize;
            bool meets = abs(dot(d, light.direction)) < dot(abs(light.direction), vec3(voxelSize));
            vec3 reach = side ? vec3(voxelSize) : bounds;
            bool on = (light.flags & LIGHT_FROM_EMITTER) != 0u && (side ? meets : facing) &&
                      abs(dot(d, u)) < length(light.halfU) + dot(abs(u), reach) &&
                      abs(dot(d, v)) < length(light.halfV) + dot(abs(v), reach);
            if (isSphere(light))
                on = (light.flags & LIGHT_FROM_EMITTER) != 0u &&
                     length(max(abs(d) - voxelSize, 0.0)) < length(light.halfU);
            found = found || on;
        } while (++i < lighting.lightEnds.w);
#endif
    return found;
}

void main() {
    uint index = min(linearIndex(), max(grid.faceCount, 1u) - 1u);
    bool inside = linearIndex() < grid.faceCount;
    FaceRecord face = faces[index];
    vec3 normal = faceNormal(face);
    vec3 position = worldFromGrid(faceCenter(face));
    uvec4 material = texelFetch(voxelFaceMaterials, int(index));
    vec3 emission = unpackEmission(material);
#if NESTED_GRIDS
    float voxelSize = voxelEdge(face.voxel) * grid.voxelSize;
#else
    float voxelSize = grid.voxelSize;
#endif
    bool areaLight = emission != vec3(0.0) && isAreaLight(face, position, normal, voxelSize);
    if (areaLight) emission = vec3(0.0);
#if EMISSION_FITS
    emission *= uintBitsToFloat(texelFetch(emissionParts, int(index)).x);
#endif
    vec3 reflectance = unpackAlbedo(material.x) * (1.0 / 3.14159265358979);
    Receiver receiver = Receiver(position, normal, normal, normal, kShadowVoxelLift);
    Brdf none;
#if GLASS
    veilNear = kVeilNearVoxels * voxelSize;
#endif
    DirectLight light = DirectLight(vec3(0.0), vec3(0.0));
    addRectLights(light, false, receiver, none);
#if GLASS
    light.irradiance += causticIrradiance(position, normal, voxelSize);
#endif
#if FOR_RAYS
    vec3 steady = emission + reflectance * light.irradiance;
#endif
    addPunctualLights(light, false, receiver, none);
    if (!inside) return;
    uint bits = 0u;
#if FOR_RAYS
    cachedDirect[index] = packRgb9e5(steady);
    bits = (material.w << FACE_LOBE_SHIFT) | (areaLight ? FACE_AREA_LIGHT : 0u);
#endif
    litFaces[index] = LitFace(material.x, packRgb9e5(emission + reflectance * light.irradiance), 0u, bits);
}
