#version 450 core
// SPDX-License-Identifier: MIT
// Lit faces -> level 0 of the radiance volume. One invocation per occupied voxel, so no two store to one
// texel. A face sends out radiance + albedo * irradiance / pi; its opacity is its coverage W, at most 1.
#ifndef DIRECTIONAL
#error DIRECTIONAL must be 0 or 1
#endif
layout(local_size_x = 64) in;  // before linear_index, which asks for it
#include "lib/linear_index.glsl"
#include "lib/lit_face.glsl"
#include "lib/radiance_volume.glsl"
#include "lib/voxel_grid.glsl"
#include "lib/voxel_record.glsl"
layout(std430) readonly buffer FaceTable { FaceRecord faces[]; };
layout(std430) readonly buffer RecordTable { uint records[]; };
layout(rgba16f) writeonly uniform image3D level0;

// Below the largest half (65504), with room for its rounding.
const float kMaxRadiance = 65000.0;

void main() {
    uint index = linearIndex();
    if (index >= grid.voxelCount) return;
    uint record = records[index];
    uint directions = faceDirections(record);
    uint faceNumber = faceBase(record);
    ivec3 voxel = unpackVoxel(faces[faceNumber].voxel);
    vec4 sum = vec4(0.0);         // weighted by coverage
    vec3 axisWeight = vec3(0.0);  // larger coverage of both sides
    do {
        int k = findLSB(directions);
        directions &= directions - 1u;
        FaceRecord face = faces[faceNumber];
        vec3 radiance = min(litRadiance(texelFetch(litFaces, int(faceNumber))), kMaxRadiance);
        ++faceNumber;
#if DIRECTIONAL
        float opacity = faceOpacity(face.offsetWeight);
        imageStore(level0, radianceTexel(voxel, k), vec4(radiance * opacity, opacity));
#else
        float weight = unpackWeight(face.offsetWeight);
        sum += vec4(radiance, 1.0) * weight;
        axisWeight = max(axisWeight, abs(directionVector(k)) * weight);
#endif
    } while (directions != 0u);
#if !DIRECTIONAL
    // The area of a plane piece with coverages W along the axes is |W|. Seen from anywhere, at most 1.
    float opacity = min(length(axisWeight), 1.0);
    imageStore(level0, radianceTexel(voxel, 0), vec4(sum.rgb / max(sum.a, 1e-6) * opacity, opacity));
#endif
}
