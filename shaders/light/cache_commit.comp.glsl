#version 450 core
// SPDX-License-Identifier: MIT
// After an update: means into the face records, where rays and pixels read them, and the flux of each chunk
// of faces. One invocation per chunk, so that sums have an order.
layout(local_size_x = 64) in;
#include "light/cache_common.glsl"
layout(std430, binding = BINDING_VOXEL_FACES) writeonly buffer FaceTable { uvec4 faces[]; };
// The same once more: software drivers read storage lane by lane in loops.
layout(binding = UNIT_VOXEL_FACES) uniform usamplerBuffer faceTexels;

void main() {
    uint chunk = linearIndex();
    uint face = min(chunk * cache.facesPerChunk, grid.faceCount - 1u);
    bool used = chunk < cache.chunkCount;
    uint end = used ? min(face + cache.facesPerChunk, grid.faceCount) : face;
    float flux = 0.0;
    do {
        bool inside = face < end;
        uint at = min(face, grid.faceCount - 1u);
        FaceCache state = states[at];
        uvec4 hitTexel = texelFetch(faceTexels, 2 * int(at));
        uvec4 shade = texelFetch(faceTexels, 2 * int(at) + 1);
        uint updates = state.counts & 0xffffu;
        bool dead = isDead(state);
        vec3 irradiance = dead ? vec3(0.0) : clamp(state.irradiance, 0.0, 65504.0);
        vec3 radiance = unpackRgb9e5(shade.y) + unpackAlbedo(shade.x) * irradiance;
        flux += inside && !dead ? faceFlux(hitTexel, radiance) : 0.0;
        shade.z = packHalf2x16(irradiance.rg);
        shade.w = packHalf2x16(vec2(irradiance.b, 0.0)) | (shade.w & (FACE_LOBE_BITS | FACE_AREA_LIGHT)) |
                  (uint(findMSB(updates) + 1) << FACE_AGE_SHIFT) |
                  (dead ? FACE_DEAD : (updates != 0u ? FACE_LIT : 0u));
        if (inside) {
            faces[2u * at + 1u].zw = shade.zw;
            // What was there is replaced by the next update, but is good until then.
            if (cache.restart != 0u) states[at].counts = (state.counts & 0xffff0000u) | min(updates, 1u);
        }
        ++face;
    } while (face < end);
    if (used) chunks[chunk] = flux;
}
