#version 450 core
// SPDX-License-Identifier: MIT
// Lit volume with all its levels -> level 0 of the same volume with one bounce more: what a voxel's surface has
// by itself, and what it reflects of the light that its diffuse cones find in the volume. One invocation per
// voxel of the marked bricks; every voxel of them is written.
//
// The surface lies where the opacity of its column does (voxelize.frag.glsl shares it between two voxels), and
// looks along the mean normal of its pieces. Limits: where normals cancel out, as in a sheet seen from both
// sides, nothing is added.
#include "lib/dot.glsl"
#include "lib/environment.glsl"
#include "lib/lighting.glsl"
#include "lib/record_steps.glsl"
#include "lib/surface.glsl"
#include "thesis/shaders/constants.h"
layout(local_size_x = 8, local_size_y = 8, local_size_z = 8) in;
#if !defined(DIFFUSE) || !defined(FRONT_CONES) || !defined(INTERMEDIATE_CONES) || !defined(SIDE_CONES)
#error DIFFUSE must be 1 (regular) or 2 (customised), the others the sizes of the enabled sets
#endif
#define DIFFUSE_CONES (FRONT_CONES + INTERMEDIATE_CONES + SIDE_CONES)
#define REGULAR 1
#define CUSTOMISED 2

layout(std140) uniform ThesisGridBlock { ThesisGrid grid; };
layout(std140) uniform ThesisBlock { ThesisConstants thesis; };
layout(std430) readonly buffer BrickList { uint brickList[]; };
uniform sampler3D volume;
uniform sampler3D ownLight;       // premultiplied radiance and opacity without bounces
uniform sampler3D surfaceAlbedo;  // of diffuse light, 0..1
uniform sampler3D surfaceNormal;  // mean, 0..1 for -1..1
#if CLIPPED_RADIANCE
layout(rgba8) uniform writeonly image3D bounced;
#else
layout(rgba16f) uniform writeonly image3D bounced;
#endif
#include "thesis/shaders/cone_samples.glsl"
#include "thesis/shaders/diffuse_cones.glsl"

// Means of normals shorter than this have no direction: a quarter of what a room's corner has.
const float kLeastNormal = 0.15;
// The largest half float is 65,504; sets of cones that bring more than there is would pass it.
const float kMaxRadiance = 60000.0;

// A voxel of one of the textures.
vec4 texelOf(sampler3D source, ivec3 voxel) {
#if OCTREE
    return octreeFetched(source, voxel, 0, 0);
#else
    return texelFetch(source, voxel, 0);
#endif
}

void store(ivec3 voxel, vec4 texel) {
#if OCTREE
    int borders = octreeBorders(voxel);
    int axes = borders;
    do {
        ivec3 node = octreeHolder(voxel, axes);
        uvec2 record = octreeNode(node, 0);
        if (octreeHas(record, 0))
            imageStore(bounced, octreeCornerOf(record, 0) + voxel - OCTREE_NODE_EDGE * node, texel);
        axes = octreeNextAxes(axes, borders);
    } while (axes >= 0);
#else
    imageStore(bounced, voxel, texel);
#endif
}

// From the middle of a voxel to the surface in it, in voxels along the axis across which it lies.
vec3 toSurface(ivec3 voxel, vec3 n) {
    vec3 along = abs(n);
    ivec3 axis = along.x >= along.y && along.x >= along.z ? ivec3(1, 0, 0)
                 : along.y >= along.z                     ? ivec3(0, 1, 0)
                                                          : ivec3(0, 0, 1);
    float here = texelOf(ownLight, voxel).a;
    float below = texelOf(ownLight, max(voxel - axis, ivec3(0))).a;
    float above = texelOf(ownLight, min(voxel + axis, ivec3(int(grid.size)) - 1)).a;
    return vec3(axis) * ((above - below) / max(here + below + above, 1e-6));
}

void main() {
    uint index = gl_WorkGroupID.y * 1024u + gl_WorkGroupID.x;
    if (index >= brickList[0]) return;
    uint bits = brickList[16u + index];
    ivec3 brick = ivec3(bits & 1023u, bits >> 10 & 1023u, bits >> 20);
    ivec3 voxel = grid.boxMin.xyz + brick * THESIS_BRICK + ivec3(gl_LocalInvocationID);

    vec4 own = texelOf(ownLight, voxel);
    vec3 n = 2.0 * texelOf(surfaceNormal, voxel).xyz - 1.0;
    float size = length(n);
    bool isLit = own.a > 0.0 && size > kLeastNormal;
    Surface s;
    s.normal = isLit ? n / size : vec3(0.0, 1.0, 0.0);
    s.position = grid.origin + grid.voxelSize * (vec3(voxel) + 0.5 + toSurface(voxel, s.normal));
    uint samples;
    vec3 gathered = traceDiffuse(s, isLit, samples);
    vec3 added = isLit ? own.a * texelOf(surfaceAlbedo, voxel).rgb * gathered : vec3(0.0);
    store(voxel, vec4(min(own.rgb + added, kMaxRadiance), own.a));
}
