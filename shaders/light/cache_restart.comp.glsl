#version 450 core
// SPDX-License-Identifier: MIT
// After a change of light: of how many updates the mean of each face counts as. What was there is replaced by the next
// updates, but is good until then. Behind cache_commit, which reads what faces share.
layout(local_size_x = 64) in;
#include "lib/edits.glsl"
#include "light/cache_common.glsl"
uniform usamplerBuffer voxelFaces;

// The updates that count of those that a face has had, after a change: 1 near it, where the next update replaces what was
// there.
uint updatesKept(uint updates, vec3 position, vec3 radiance) {
    float changed = cache.restartsNear != 0u ? 0.0 : 1.0;
    for (uint i = 0u; i < cache.placeCount; ++i) {
        uint at = editPlace(i);
        changed += changedPart(position, cache.places[at], cache.placeParts[at >> 2][at & 3u]);
    }
    changed += partOfIrradiance(cache.editedEverywhere, radiance, cache.editedEverywherePart);
    for (uint i = 0u; i < cache.lightEdits; ++i) {
        uint at = editPlace(i);
        changed += partOfLight(position, radiance, cache.editedLights[at], cache.editedAxes[at],
                               cache.editedLimits[at]);
    }
    float weight = clamp(weightAfterChange(changed), IRRADIANCE_FAR_WEIGHT, 1.0);
    float window = 1.5 / weight - 1.5;  // as (4.13) weighs
    return min(updates, window < 1.0 ? 1u : uint(window) + IRRADIANCE_SETTLE);
}

void main() {
    uint face = linearIndex();
    if (face >= grid.faceCount) return;
    uint counts = states[face].counts;
    if ((counts & CACHE_SHARES) != 0u) return;
#if NESTED_GRIDS
    vec4 place = voxelPlace(texelFetch(voxelFaces, int(face)).w);
    vec3 position = grid.origin + grid.voxelSize * (place.xyz + 0.5 * place.w);
#else
    vec3 voxel = vec3(unpackVoxel(texelFetch(voxelFaces, int(face)).w));
    vec3 position = grid.origin + grid.voxelSize * (voxel + 0.5);
#endif
    states[face].counts =
        (counts & 0xffff0000u) | updatesKept(counts & CACHE_UPDATES_MASK, position, states[face].irradiance);
}
