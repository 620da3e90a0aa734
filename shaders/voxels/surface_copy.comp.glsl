// SPDX-License-Identifier: MIT
// Update: one invocation per face. Faces of voxels in which nothing changed are taken over.
#version 450
layout(local_size_x = 64) in;
#include "lib/voxel_address.glsl"
#include "voxels/surface_common.glsl"
#include "voxels/surface_scroll.glsl"
layout(std430) readonly buffer CounterTable { uint counters[]; };
layout(std430) writeonly buffer FaceTable { uvec4 faces[]; };
layout(std430) writeonly buffer FaceMaterialTable { uvec4 faceMaterials[]; };
uniform usamplerBuffer oldFaces;
uniform usamplerBuffer oldMaterials;
uniform usamplerBuffer owners;

void main() {
    uint index = linearInvocation();
    bool used = index < min(counters[SURFACE_FACES], surface.faceCapacity);
    uint owner = texelFetch(owners, int(used ? index : 0u)).x;
    int old = int(owner & 0x1fffffffu);
    if (used && owner >> 29 == OWNER_IS_FACE) {
        uvec4 face = texelFetch(oldFaces, old);
#if NESTED_GRIDS
        ivec3 stored = unpackVoxel(face.w);
        face.w = (face.w & 0xc0000000u) | packVoxel(stored + scroll.shifts[levelOfStored(stored)].xyz);
#endif
        faces[index] = face;
        faceMaterials[index] = texelFetch(oldMaterials, old);
    }
}
