#version 450 core
// SPDX-License-Identifier: MIT
// Camera -> the lit faces of surface voxels as rays see them (component voxels): each pixel's ray through the
// voxels, and the light of the face that it meets.
#define EXACT_DIRECT 0
#include "lib/gbuffer.glsl"
#include "lib/voxel_light.glsl"
layout(local_size_x = 8, local_size_y = 8) in;
layout(rgba32f, binding = 0) writeonly uniform image2D result;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    vec3 origin = gridFromWorld(frame.eye);
    vec3 direction = normalize(pixelRay(pixel));
    VoxelHit hit = traceVoxels(origin, direction, 1e9);
    vec3 radiance = hitRadiance(hit, origin, direction);
    if (any(greaterThanEqual(pixel, imageSize(result)))) return;
    imageStore(result, pixel, vec4(radiance, hit.face >= 0 ? 1.0 : 0.0));
}
