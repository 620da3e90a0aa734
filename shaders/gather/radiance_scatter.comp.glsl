#version 450 core
// SPDX-License-Identifier: MIT
// Lit faces -> level 0 of the radiance volume. One invocation per occupied voxel, so no two store to one
// texel. A face sends out radiance + albedo * irradiance / pi; its opacity is its coverage W, at most 1.
//   OCTREE  level0 is the octree's texture of bricks; a voxel is stored in each brick that holds it
#if !defined(DIRECTIONAL) || !defined(OCTREE)
#error DIRECTIONAL and OCTREE must be 0 or 1
#endif
layout(local_size_x = 64) in;  // before linear_index, which asks for it
#include "lib/dot.glsl"
#include "lib/linear_index.glsl"
#include "lib/lit_face.glsl"
#include "lib/radiance_volume.glsl"
#if OCTREE
#include "lib/radiance_octree.glsl"
#endif
#include "lib/voxel_grid.glsl"
#include "lib/voxel_record.glsl"
layout(std430) readonly buffer FaceTable { FaceRecord faces[]; };
layout(std430) readonly buffer RecordTable { uint records[]; };
layout(rgba16f) writeonly uniform image3D level0;

// Below the largest half (65504), with room for its rounding.
const float kMaxRadiance = 65000.0;

void store(ivec3 voxel, int k, vec4 value) {
#if OCTREE
    int borders = octreeBorders(voxel);
    int axes = borders;
    do {
        ivec3 node = octreeHolder(voxel, axes);
        imageStore(level0, octreeCornerOf(octreeNode(node, 0), k) + voxel - OCTREE_NODE_EDGE * node, value);
        axes = octreeNextAxes(axes, borders);
    } while (axes >= 0);
#else
    imageStore(level0, radianceTexel(voxel, k), value);
#endif
}

void main() {
    uint index = linearIndex();
    if (index >= grid.voxelCount) return;
    uint record = records[index];
    uint directions = faceDirections(record);
    if (directions == 0u) return;  // triangles that touch the voxel, and no area
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
        store(voxel, k, vec4(radiance * opacity, opacity));
#else
        float weight = unpackWeight(face.offsetWeight);
        sum += vec4(radiance, 1.0) * weight;
        axisWeight = max(axisWeight, abs(directionVector(k)) * weight);
#endif
    } while (directions != 0u);
#if !DIRECTIONAL
    // The area of a plane piece with coverages W along the axes is |W|. Seen from anywhere, at most 1.
    float opacity = min(length(axisWeight), 1.0);
    store(voxel, 0, vec4(sum.rgb / max(sum.a, 1e-6) * opacity, opacity));
#endif
}
