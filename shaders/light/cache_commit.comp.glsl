#version 450 core
// SPDX-License-Identifier: MIT
// After an update: means into the face records, where rays read them, and into faceLight, where pixels do;
// and the flux of each chunk of faces. One invocation per chunk, so that sums have an order.
layout(local_size_x = 64) in;
#include "light/cache_common.glsl"
#include "light/cache_state.glsl"
layout(binding = CACHE_UNIT_STATE) uniform usamplerBuffer stateTexels;
layout(std430, binding = BINDING_VOXEL_FACES) writeonly buffer FaceTable { uvec4 faces[]; };
// The same once more: software drivers read storage lane by lane in loops.
layout(binding = UNIT_VOXEL_FACES) uniform usamplerBuffer faceTexels;
layout(std430, binding = CACHE_FACE_LIGHT) writeonly buffer FaceLightTable { uvec2 faceLight[]; };

// The inside of a solid lies next to its outside. Of a cloth that is seen from its other side nothing else is
// there, so that a small weight does as well as a large one: this part of it.
const uint kReversePart = 64u;

// In 16 bits, as unpackWeight reads it from the upper half of a word.
uint weightAtPixels(uvec4 hitTexel, bool lit) {
    uint weight = hitTexel.y >> 16;
    if ((hitTexel.z & FACE_REVERSE) != 0u) weight = (weight + kReversePart - 1u) / kReversePart;
    return lit ? weight : 0u;
}

void main() {
    uint chunk = linearIndex();
    uint face = min(chunk * cache.facesPerChunk, grid.faceCount - 1u);
    bool used = chunk < cache.chunkCount;
    uint end = used ? min(face + cache.facesPerChunk, grid.faceCount) : face;
    float flux = 0.0;
    do {
        bool inside = face < end;
        uint at = min(face, grid.faceCount - 1u);
        FaceCache state = unpackState(texelFetch(stateTexels, int(at)));
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
            faceLight[at] = uvec2(shade.z, packHalf2x16(vec2(irradiance.b, 0.0)) |
                                               weightAtPixels(hitTexel, !dead && updates != 0u) << 16);
            // What was there is replaced by the next update, but is good until then.
            if (cache.restart != 0u) states[at].counts = (state.counts & 0xffff0000u) | min(updates, 1u);
        }
        ++face;
    } while (face < end);
    if (used) chunks[chunk] = flux;
}
