// SPDX-License-Identifier: MIT
// A change of light at a place: how much of it is another, and whether it is better scaled (docs/theory/4d_cache.md, "Lights
// that change", "Light that is scaled"). EDITS: the uniform block that holds the change, as CacheConstants.
#ifndef EDITS
#error EDITS must be the block with the edits
#endif
#include "lib/dot.glsl"
#include "lib/edits.glsl"

const int kSpreadSteps = 3;
// Light is scaled where less than this is left of a change: where both are alike it stays as it is.
const float kClearlyLess = 0.9;

// What lamps may bring to a place, W/m^2, were they all the root of `spread2` farther away: all of them; how fast that
// falls with spread2; what is another than it was; and what is another than `lightScale` times that.
struct LampShares {
    float all, slope, asItWas, scaled;
};

// Of one lamp, with what is another as `asItWas`.
LampShares lampShares(vec3 position, float spread2, vec4 light, vec4 axis, vec4 limits) {
    vec3 apart = position - light.xyz;
    apart -= max(dot(apart, axis.xyz), 0.0) * axis.xyz;
    float d = max(length(apart) - axis.w, 1e-6);
    float inverse = 1.0 / (d * d + spread2);
    float all = 0.5 * limits.z * inverse;
    return LampShares(all, all * inverse, 0.5 * light.w * limits.w * inverse, 0.0);
}

void addShares(inout LampShares sum, LampShares one, bool scaled) {
    sum.all += one.all;
    sum.slope += one.slope;
    sum.asItWas += scaled ? 0.0 : one.asItWas;
    sum.scaled += scaled ? one.asItWas : 0.0;
}

// Where lamps bring more than the `irradiance` that is there, light is spread: Newton's step for 1 / all, which is exact for
// one lamp.
float spreadMore(float spread2, LampShares shares, float irradiance) {
    float over = shares.all / max(irradiance, 1e-12) - 1.0;
    return max(spread2 + over * shares.all / max(shares.slope, 1e-30), 0.0);
}

// Of the light at `position`, where white surfaces have `radiance`, the part that a change made another. `scaled`: where
// `radiance` has been multiplied by lightScale.
float changedLight(vec3 position, vec3 radiance, bool scaled) {
    float changed = partOfIrradiance(scaled ? EDITS.scaledEverywhere : EDITS.editedEverywhere, radiance,
                                     scaled ? EDITS.scaledEverywherePart : EDITS.editedEverywherePart);
    uint end = scaled ? EDITS.allLightEdits : EDITS.lightEdits;
    for (uint i = scaled ? EDITS.lightEdits : 0u; i < end; ++i) {
        uint at = editLight(i);
        changed += partOfLight(position, radiance, EDITS.editedLights[at], EDITS.editedAxes[at],
                               EDITS.editedLimits[at]);
    }
    return changed;
}

// Whether `position`, where white surfaces have `radiance`, has better light when that is scaled.
bool isBetterScaled(vec3 position, vec3 radiance) {
    float irradiance = irradianceOf(radiance);
    int steps = EDITS.allLightEdits > 0u ? kSpreadSteps : 0;
    LampShares shares;
    float spread2 = 0.0;
    for (int step = 0; step <= steps; ++step) {
        shares = LampShares(0.0, 0.0, 0.0, 0.0);
        for (uint i = 0u; i < EDITS.allLightEdits; ++i) {
            uint at = editLight(i);
            LampShares one = lampShares(position, spread2, EDITS.editedLights[at], EDITS.editedAxes[at],
                                        EDITS.editedLimits[at]);
            addShares(shares, one, i >= EDITS.lightEdits);
        }
        spread2 = step < steps ? spreadMore(spread2, shares, irradiance) : spread2;
    }
    float scaledIrradiance = irradianceOf(EDITS.lightScale * radiance);
    float left = shares.scaled + min(EDITS.dimmed.z, EDITS.dimmed.w * scaledIrradiance);
    float changed = shares.asItWas + min(EDITS.dimmed.x, EDITS.dimmed.y * irradiance);
    return left < kClearlyLess * changed;
}
