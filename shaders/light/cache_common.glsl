// SPDX-License-Identifier: MIT
// What the passes of the irradiance cache share that deal with the flux of faces, for the pool of light
// samples.
#include "lib/dot.glsl"
#include "lib/linear_index.glsl"
#include "lib/voxel_grid.glsl"
#include "lib/voxel_record.glsl"
#include "light/cache_state.glsl"
layout(std140) uniform CacheBlock { CacheConstants cache; };
layout(std430) buffer StateTable { FaceCache states[]; };
// Per chunk of faces: its flux, then the flux of all chunks before it.
layout(std430) buffer ChunkTable { float chunks[]; };

// How much of the pool a face gets (docs/theory/4c_estimator.md, (4.11)).
float faceFlux(uvec4 hitTexel, vec3 radiance) {
    vec3 n = octDecode(unpackSnorm2x16(hitTexel.x));
    vec3 lower, upper;
    lightSampleBounds(hitTexel, n, vec3(0.0), 1.0, lower, upper);
    vec3 size = max(upper - lower, vec3(0.0));
    uint axis = hitTexel.w >> 30;
    float seen = axis == 0u ? size.y * size.z : (axis == 1u ? size.z * size.x : size.x * size.y);
    float facing = axis == 0u ? n.x : (axis == 1u ? n.y : n.z);
    return dot(radiance, vec3(1.0 / 3.0)) * seen * dominantFaceShare(n, axis) / max(abs(facing), 1e-3);
}
