// SPDX-License-Identifier: MIT
// What a thing that moved or a light that changed changes of the light elsewhere, and how much of its mean a place should
// then keep (docs/theory/4d_cache.md, "Things that move", "Lights that change").
#include "lib/dot.glsl"
#include "shared/irradiance.h"

const float kThirdOfPi = 1.04719755;

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

// At a place where a white surface has `radiance`: mean of the channels.
float irradianceOf(vec3 radiance) { return kThirdOfPi * (radiance.r + radiance.g + radiance.b); }

// Of the irradiance at a place the part that `changed` W/m^2 are, `most` at most. `radiance`: of a white surface there.
float partOfIrradiance(float changed, vec3 radiance, float most) {
    return min(changed / max(irradianceOf(radiance), 1e-12), most);
}

// The same at `position` for a light with its center and flux, its axis and radius, and its reach and part in `limits`. It
// brings there what its flux is on the walls of a cube with the diagonal d.
float partOfLight(vec3 position, vec3 radiance, vec4 light, vec4 axis, vec4 limits) {
    vec3 apart = position - light.xyz;
    apart -= max(dot(apart, axis.xyz), 0.0) * axis.xyz;
    float d = max(length(apart) - axis.w, 1e-6);
    return partOfIrradiance(light.w / (2.0 * d * d), radiance, limits.y) * min(limits.x / d, 1.0);
}

// The weight of what is gathered next, in a mean, that errs least: by noise of many frames, and by what it lags.
float weightAfterChange(float changed) { return pow(2.0 / IRRADIANCE_NOISE * changed, 2.0 / 3.0); }
