#version 450 core
// SPDX-License-Identifier: MIT
// Camera -> the radiance volume itself, texels of one level as opaque cubes (component voxels). Each ray
// walks from texel to texel (Amanatides and Woo 1987, "A Fast Voxel Traversal Algorithm for Ray Tracing") to
// the first that holds surface. Six directions: the block of the side that is entered, or the mean of all
// when nothing there looks that way.
#ifndef DIRECTIONAL
#error DIRECTIONAL must be 0 or 1
#endif
#define AREA 1
#include "lib/cone_trace.glsl"
#include "lib/gbuffer.glsl"
layout(local_size_x = 8, local_size_y = 8) in;
layout(rgba32f, binding = 0) writeonly uniform image2D result;

// Texels with less opacity are left out: dust of halves.
const float kLeastOpacity = 1.0 / 1024.0;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(result)))) return;
    int level = min(cones.voxelLevel, int(volume.maxLevel));
    ivec3 size = ivec3(volume.sizeX, volume.sizeY, volume.sizeZ) >> level;
    float texelSize = volume.voxelSize * exp2(float(level));

    // Texel coordinates; the direction is per metre, so that t is a distance.
    vec3 ray = normalize(pixelRay(pixel));
    vec3 d = mix(ray, vec3(1e-9), lessThan(abs(ray), vec3(1e-9))) / texelSize;
    vec3 o = (frame.eye - volume.origin) / texelSize;
    vec3 a = -o / d;
    vec3 b = (vec3(size) - o) / d;
    vec3 near = min(a, b);
    vec3 far = max(a, b);
    float enter = max(max(near.x, near.y), max(near.z, 0.0));
    bool meets = min(far.x, min(far.y, far.z)) > enter;

    ivec3 texel = clamp(ivec3(floor(o + enter * d)), ivec3(0), size - 1);
    ivec3 stride = ivec3(sign(d));
    vec3 next = (vec3(texel) + max(vec3(stride), 0.0) - o) / d;
    vec3 perTexel = 1.0 / abs(d);
    // The side through which the volume is entered.
    int axis = near.x >= near.y && near.x >= near.z ? 0 : near.y >= near.z ? 1 : 2;

    vec4 found = vec4(0.0);
    bool going = meets;
    int budget = size.x + size.y + size.z;
    do {
        vec4 side = vec4(0.0);
        vec4 mean = vec4(0.0);
#if DIRECTIONAL
        int facing = 2 * axis + (stride[axis] > 0 ? 1 : 0);
        for (int k = 0; k < 6; ++k) {
            vec4 s = texelFetch(radianceVolume, texel + ivec3(k * size.x, 0, 0), level);
            mean += s;
            side = k == facing ? s : side;
        }
#else
        mean = texelFetch(radianceVolume, texel, level);
#endif
        vec4 s = side.a > kLeastOpacity ? side : mean;
        found = going && s.a > kLeastOpacity ? vec4(s.rgb / s.a, 1.0) : found;
        // Step over the nearest of the three sides.
        axis = next.x <= next.y && next.x <= next.z ? 0 : next.y <= next.z ? 1 : 2;
        ivec3 chosen = ivec3(axis == 0, axis == 1, axis == 2);
        texel += chosen * stride;
        next += vec3(chosen) * perTexel;
        going =
            going && found.a == 0.0 && all(greaterThanEqual(texel, ivec3(0))) && all(lessThan(texel, size));
    } while (going && --budget > 0);
    imageStore(result, pixel, found.a > 0.0 ? found : vec4(frame.sky, 0.0));
}
