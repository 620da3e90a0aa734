// SPDX-License-Identifier: MIT
// What a thing that moved or a light that changed changes of the light elsewhere, and how much of its mean a place should
// then keep (docs/theory/4d_cache.md, "Things that move", "Lights that change").
#include "lib/dot.glsl"
#include "shared/irradiance.h"

const float kThirdOfPi = 1.04719755;

// Place `i` of a list. Said so, drivers do not write the loop over a list out place by place.
uint editPlace(uint i) { return min(i, CHANGED_PLACES - 1u); }

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

// W/m^2 by which irradiance at `position` is another, for a light with its center and flux, its axis and radius: flux over
// the walls of a cube with the diagonal d.
float changedIrradiance(vec3 position, vec4 light, vec4 axis, float reach) {
    vec3 apart = position - light.xyz;
    apart -= max(dot(apart, axis.xyz), 0.0) * axis.xyz;
    float d = max(length(apart) - axis.w, 1e-6);
    return light.w / (2.0 * d * d) * min(reach / d, 1.0);
}

// That as a part of what there is: `radiance` of a white surface.
float partOfIrradiance(float changed, vec3 radiance) {
    return changed / max(kThirdOfPi * (radiance.r + radiance.g + radiance.b), 1e-12);
}

// The weight of what is gathered next, in a mean, that errs least: by noise of many frames, and by what it lags.
float weightAfterChange(float changed) { return pow(2.0 / IRRADIANCE_NOISE * changed, 2.0 / 3.0); }
