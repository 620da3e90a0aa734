// SPDX-License-Identifier: MIT
// Of the light that a face holds, the part that a change made another.
#include "lib/edits.glsl"
#include "light/cache_common.glsl"
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

// `scaled`: `radiance` has been multiplied by lightScale.
float changedLight(vec3 position, vec3 radiance, bool scaled) {
    float changed = partOfIrradiance(scaled ? cache.scaledEverywhere : cache.editedEverywhere, radiance,
                                     scaled ? cache.scaledEverywherePart : cache.editedEverywherePart);
    uint end = scaled ? cache.allLightEdits : cache.lightEdits;
    for (uint i = scaled ? cache.lightEdits : 0u; i < end; ++i) {
        uint at = editLight(i);
        changed += partOfLight(position, radiance, cache.editedLights[at], cache.editedAxes[at],
                               cache.editedLimits[at]);
    }
    return changed;
}

// Whether `position`, where white surfaces have `radiance`, has better light when that is scaled.
bool isBetterScaled(vec3 position, vec3 radiance) {
    float irradiance = kThirdOfPi * (radiance.r + radiance.g + radiance.b);
    LampShares shares;
    float spread2 = 0.0;
    for (int step = 0; step <= kSpreadSteps; ++step) {
        shares = LampShares(0.0, 0.0, 0.0, 0.0);
        for (uint i = 0u; i < cache.allLightEdits; ++i) {
            uint at = editLight(i);
            LampShares one = lampShares(position, spread2, cache.editedLights[at], cache.editedAxes[at],
                                        cache.editedLimits[at]);
            addShares(shares, one, i >= cache.lightEdits);
        }
        spread2 = step < kSpreadSteps ? spreadMore(spread2, shares, irradiance) : spread2;
    }
    vec3 scaled = cache.lightScale * radiance;
    float scaledIrradiance = kThirdOfPi * (scaled.r + scaled.g + scaled.b);
    float left = shares.scaled + min(cache.dimmed.z, cache.dimmed.w * scaledIrradiance);
    float changed = shares.asItWas + min(cache.dimmed.x, cache.dimmed.y * irradiance);
    return left < kClearlyLess * changed;
}
