// SPDX-License-Identifier: MIT
// What a thing that moved changes of the light elsewhere, and how much of its mean a place should then keep
// (docs/theory/4d_cache.md, "Things that move").
#include "lib/dot.glsl"
#include "shared/irradiance.h"

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

// The weight of what is gathered next, in a mean, that errs least: by noise of many frames, and by what it lags.
float weightAfterChange(float changed) { return pow(2.0 / IRRADIANCE_NOISE * changed, 2.0 / 3.0); }
