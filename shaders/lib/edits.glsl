// SPDX-License-Identifier: MIT
// What a thing that moved or a light that changed changes of the light elsewhere, and how much of its mean a place should
// then keep (docs/theory/4d_cache.md, "Things that move", "Lights that change").
#include "lib/dot.glsl"
#include "shared/irradiance.h"

const float kThirdOfPi = 1.04719755;
const int kSpreadSteps = 3;
const float kClearlyLess =
    0.9;  // light is scaled where less than this is left of a change: where both are alike it stays

// Place `i` of a list. Said so, drivers do not write the loop over a list out place by place.
uint editPlace(uint i) { return min(i, CHANGED_PLACES - 1u); }
uint editLight(uint i) { return min(i, CHANGED_LIGHTS - 1u); }

// The part of what `position` sees that changed inside the sphere round `place`, radius in w, of whose cross-section `part`
// changed: about part r^2 / d^2.
float changedPart(vec3 position, vec4 place, float part) {
    vec3 apart = position - place.xyz;
    return part * place.w * place.w / max(dot(apart, apart), 1e-12);
}

// The same of what is seen in a lobe about `axis`, `spread` wide, radians. The edge of what moved may be all of it, so that
// the part does not count.
float changedInLobe(vec3 position, vec3 axis, float spread, vec4 place) {
    vec3 towards = place.xyz - position;
    float sine = place.w / max(length(towards), 1e-6);
    float beside = max(length(normalize(towards) - axis) - sine, 0.0) / spread;
    float covered = min(sine / spread, 1.0);
    float falloff = 1.0 / (1.0 + beside * beside);
    return sine >= 1.0 ? 1.0 : covered * covered * falloff * falloff;
}

// Of the irradiance at a place the part that `changed` W/m^2 are, `most` at most. `radiance`: of a white surface there.
float partOfIrradiance(float changed, vec3 radiance, float most) {
    return min(changed / max(kThirdOfPi * (radiance.r + radiance.g + radiance.b), 1e-12), most);
}

// The same at `position` for a light with its center and flux, its axis and radius, and its reach and part in `limits`. It
// brings there what its flux is on the walls of a cube with the diagonal d.
float partOfLight(vec3 position, vec3 radiance, vec4 light, vec4 axis, vec4 limits) {
    vec3 apart = position - light.xyz;
    apart -= max(dot(apart, axis.xyz), 0.0) * axis.xyz;
    float d = max(length(apart) - axis.w, 1e-6);
    return partOfIrradiance(light.w / (2.0 * d * d), radiance, limits.y) * min(limits.x / d, 1.0);
}

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

// The weight of what is gathered next, in a mean, that errs least: by noise of many frames, and by what it lags.
float weightAfterChange(float changed) { return pow(2.0 / IRRADIANCE_NOISE * changed, 2.0 / 3.0); }
