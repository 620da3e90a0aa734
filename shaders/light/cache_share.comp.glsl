#version 450 core
// SPDX-License-Identifier: MIT
// Behind cache_commit where faces share with their neighbours: what pixels see of a face is shared once more, with those
// two voxels away on its plane. Both together take the mean of up to 25 faces by eight looks: an a-trous filter
// (Dammertz et al. 2010, "Edge-Avoiding A-Trous Wavelet Transform for fast Global Illumination Filtering", section 2).
layout(local_size_x = 64) in;
#include "lib/dot.glsl"
#include "light/cache_common.glsl"
uniform usamplerBuffer stateTexels;
uniform usamplerBuffer voxelFaces;
uniform usamplerBuffer voxelRecords;
layout(rgba32ui) readonly uniform uimage3D voxelBrickImage;
uniform usamplerBuffer sharedLight;  // as cache_commit leaves it
layout(std430) writeonly buffer FaceLightTable { uvec2 faceLight[]; };
#include "light/face_plane.glsl"

vec3 lightOf(uvec2 texel) { return vec3(unpackHalf2x16(texel.x), unpackHalf2x16(texel.y & 0xffffu).x); }

vec4 neighbourLight(int side, vec3 own, uint updates, uvec4 hitTexel, vec3 n) {
    int face = neighbourOnPlane(side, 2, hitTexel, n);
    uvec2 texel = texelFetch(sharedLight, max(face, 0)).xy;
    vec3 light = lightOf(texel);
    bool counts = face >= 0 && (texel.y >> 16) != 0u;
    return counts ? vec4(light, 1.0) * likeness(own, light, updates) : vec4(0.0);
}

void main() {
    uint face = linearIndex();
    if (face >= grid.faceCount) return;
    uvec2 own = texelFetch(sharedLight, int(face)).xy;
    uvec4 hitTexel = texelFetch(voxelFaces, int(face));
    int owner = stateOwner(int(face), texelFetch(stateTexels, int(face)));
    uint updates = texelFetch(stateTexels, owner).w & CACHE_UPDATES_MASK;
    vec3 light = lightOf(own);
    vec3 n = octDecode(unpackSnorm2x16(hitTexel.x));
    vec4 sum =
        neighbourLight(0, light, updates, hitTexel, n) + neighbourLight(1, light, updates, hitTexel, n);
    sum += neighbourLight(2, light, updates, hitTexel, n) + neighbourLight(3, light, updates, hitTexel, n);
    sum = vec4(light, 1.0) + ((own.y >> 16) != 0u ? sum : vec4(0.0));
    vec3 shown = clamp(sum.rgb / sum.a, 0.0, 65504.0);
    faceLight[face] = uvec2(packHalf2x16(shown.rg), packHalf2x16(vec2(shown.b, 0.0)) | (own.y & 0xffff0000u));
}
