#version 450 core
// SPDX-License-Identifier: MIT
// One more draw of many lamps (lib/lamp_tree.glsl) at each face of a part of the table, and the mean so far ->
// the face's radiance: what light/inject_light.comp.glsl has put there of all other lights, plus that of the lamps.
layout(local_size_x = 64) in;
#define NEAR_TRIANGLES 1
#define BLOCKING_TRIANGLES 1
#include "lib/dot.glsl"
#include "lib/linear_index.glsl"
// For rays and glass, before them.
#include "lib/scene_tables.glsl"
#include "lib/surface_array.glsl"
// The others.
#include "lib/lamp_tree.glsl"
#include "lib/voxel_grid.glsl"
#include "lib/voxel_record.glsl"
#include "shared/irradiance.h"
#include "shared/lamps.h"
layout(std140) uniform LampFaceBlock { LampFaceConstants lampFaces; };
layout(std430) readonly buffer FaceTable { FaceRecord faces[]; };
layout(std430) buffer LitFaceTable { LitFace litFaces[]; };
// Irradiance and number of draws, four halves; radiance without the lamps, RGB9E5.
layout(std430) buffer LampMeanTable { uvec4 lampMeans[]; };
uniform usamplerBuffer voxelFaceMaterials;

// Height above a face at which rays start, voxels: its triangles lie about its plane.
const float kFaceHeight = 0.1;

void main() {
    uint index = min(lampFaces.firstFace + linearIndex(), max(grid.faceCount, 1u) - 1u);
    bool inside = linearIndex() < lampFaces.faceCount && lampFaces.firstFace + linearIndex() < grid.faceCount;
    FaceRecord face = faces[index];
    vec3 normal = faceNormal(face);
    vec3 position = worldFromGrid(faceCenter(face));
#if NESTED_GRIDS
    float voxelSize = voxelEdge(face.voxel) * grid.voxelSize;
#else
    float voxelSize = grid.voxelSize;
#endif
#if GLASS
    veilNear = kVeilNearVoxels * voxelSize;
#endif
    Receiver receiver = Receiver(position, normal, normal, normal, vec2(0.0));
    Brdf none;
    vec3 start = position + kFaceHeight * voxelSize * normal;
    // Faces keep their numbers from one voxelization to the next by voxel and axis.
    uint seed = randomHash(randomHash(face.voxel) ^ 0x51ed270bu);
    vec3 irradiance =
        lampLight(false, receiver, none, start, LampDraw(seed, lampFaces.round, inside)).irradiance;
    if (!inside) return;
    bool first = lampFaces.restarts != 0u;
    uvec4 bits = first ? uvec4(0u, 0u, litFaces[index].radiance, 0u) : lampMeans[index];
    vec4 mean = vec4(unpackHalf2x16(bits.x), unpackHalf2x16(bits.y));
    mean.a += 1.0;
    mean.rgb += (min(irradiance, vec3(65000.0)) - mean.rgb) / mean.a;
    lampMeans[index] = uvec4(packHalf2x16(mean.rg), packHalf2x16(mean.ba), bits.z, 0u);
    vec3 reflectance = unpackAlbedo(texelFetch(voxelFaceMaterials, int(index)).x) * (1.0 / 3.14159265358979);
    litFaces[index].radiance = packRgb9e5(unpackRgb9e5(bits.z) + reflectance * mean.rgb);
}
