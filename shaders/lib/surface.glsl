// SPDX-License-Identifier: MIT
// A surface as the shading functions see it (lib/brdf.glsl, lib/lights.glsl): from the G-buffer
// (lib/gbuffer.glsl) or put together by hand. World space, metres.

struct Surface {
    vec3 position;
    vec3 toEye;            // unit
    vec3 normal;           // shading normal, unit, facing the eye
    vec3 geometricNormal;  // of the triangle, unit, facing the eye
    float normalMean;      // length of the mean of the normals that it stands for: its share of direct light
    vec3 albedo;           // base colour: diffuse albedo of a dielectric, F0 of a metal; 0 when unlit
    float metallic;
    float roughness;    // perceptual, [0,1]
    vec3 dielectricF0;  // reflectance of the dielectric at normal incidence
    vec3 emission;      // radiance towards the eye; an unlit surface's base colour
    float depth;        // view depth, m
    uint instance;      // index into the instance table
    uint material;      // index into the material table
    bool backFacing;
    bool unlit;
};
