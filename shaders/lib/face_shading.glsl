// SPDX-License-Identifier: MIT
// What faces of voxels show to rays that hit them. Part of lib/voxel_light.glsl.
#include "lib/dot.glsl"
#include "lib/lit_face.glsl"
#include "lib/octahedral.glsl"

// Edge of a face's voxel, in voxels of level 0.
#if NESTED_GRIDS
float faceEdge(int face) { return voxelEdge(texelFetch(voxelFaces, face).w); }
#else
float faceEdge(int face) { return 1.0; }
#endif

struct FaceShading {
    vec3 albedo;
    vec3 directRadiance;  // emission and reflected direct light, W/(sr m^2)
    vec3 irradiance;      // cached indirect irradiance / pi
    bool cached;          // false: never updated, or inside a closed object
};

FaceShading faceShading(int face) {
    uvec4 lit = texelFetch(litFaces, face);
    return FaceShading(unpackAlbedo(lit.x), unpackRgb9e5(lit.y), litIrradiance(lit),
                       (lit.w & (FACE_LIT | FACE_INTERIOR)) == FACE_LIT);
}

// Outgoing radiance of a diffuse face: emission, reflected direct light, reflected cached light.
vec3 outgoingRadiance(int face) { return litRadiance(texelFetch(litFaces, face)); }

// Importance of a radiance for sampling. The plain mean of the channels: blue light counts as much.
float brightness(vec3 radiance) { return dot(radiance, vec3(1.0 / 3.0)); }

vec3 faceNormalOf(int face) { return octDecode(unpackSnorm2x16(texelFetch(voxelFaces, face).x)); }
