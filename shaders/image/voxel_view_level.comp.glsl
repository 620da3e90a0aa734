#version 450 core
// SPDX-License-Identifier: MIT
// Means over voxels for views at coarser levels than voxels. One invocation per texel: FIRST 1 from the faces
// of its 2^3 voxels, eight texels for each occupied brick, the others are zero before; FIRST 0 from the 2^3
// texels of the level before. Pieces of surface add up by projected area,
// as along cones (opacity model area): four voxels of wall fill a texel of 2^3.
#ifndef FIRST
#error FIRST must be 0 or 1
#endif
#include "shared/voxel_view.h"
#if FIRST
layout(local_size_x = 64) in;
#include "lib/linear_index.glsl"
#include "lib/ray_query.glsl"
#include "lib/voxel_data.glsl"
layout(std430) readonly buffer BrickTable { uint brickList[]; };
#else
layout(local_size_x = 8, local_size_y = 4, local_size_z = 4) in;
layout(rgba16f) readonly uniform image3D finer;
#endif
layout(std140) uniform ViewBlock { VoxelViewConstants view; };
layout(rgba16f) writeonly uniform image3D coarser;

#if FIRST
vec4 finerTexel(ivec3 voxel) {
    uvec4 word = imageLoad(voxelBrickImage, voxel >> 2);
    uint bit = bitOfVoxel(voxel);
    if (!brickHas(word.xy, bit)) return vec4(0.0);
    uint record = texelFetch(voxelRecords, int(voxelRecordIndex(word, bit))).x;
    return voxelMean(record, vec3(0.0), view.data);
}
#else
vec4 finerTexel(ivec3 texel) { return imageLoad(finer, texel); }
#endif

void main() {
#if FIRST
    uint index = linearIndex();
    if (index >= 8u * grid.occupiedBricks) return;
    ivec3 texel = 2 * unpackVoxel(brickList[index >> 3]) + (ivec3(index, index >> 1, index >> 2) & 1);
#else
    ivec3 texel = ivec3(gl_GlobalInvocationID);
#endif
    if (any(greaterThanEqual(texel, imageSize(coarser)))) return;
    vec4 sum = vec4(0.0);
    for (int i = 0; i < 8; ++i) sum += finerTexel(2 * texel + ivec3(i & 1, (i >> 1) & 1, i >> 2));
    float opacity = min(0.25 * sum.a, 1.0);
    // Below the largest half.
    vec3 color = min(sum.rgb / max(sum.a, 1e-12), 65000.0);
    imageStore(coarser, texel, vec4(color * opacity, opacity));
}
