// SPDX-License-Identifier: MIT
// What the passes share that take a change of light to all faces.
#include "light/cache_common.glsl"
#define EDITS cache
#include "lib/light_change.glsl"
uniform usamplerBuffer voxelFaces;

vec3 facePosition(uint face) {
#if NESTED_GRIDS
    vec4 place = voxelPlace(texelFetch(voxelFaces, int(face)).w);
    return grid.origin + grid.voxelSize * (place.xyz + 0.5 * place.w);
#else
    vec3 voxel = vec3(unpackVoxel(texelFetch(voxelFaces, int(face)).w));
    return grid.origin + grid.voxelSize * (voxel + 0.5);
#endif
}
