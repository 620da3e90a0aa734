// SPDX-License-Identifier: MIT
// What a thing that moved changes of the light elsewhere, and how much of its mean a place should then keep
// (docs/theory/4d_cache.md, "Things that move").
#include "lib/dot.glsl"
#include "shared/irradiance.h"

// The part of what `position` sees that changed inside the sphere round `place`, radius in w: about r^2 / d^2.
float changedPart(vec3 position, vec4 place) {
    vec3 apart = position - place.xyz;
    return place.w * place.w / max(dot(apart, apart), 1e-12);
}

// The weight of what is gathered next, in a mean, that errs least: by noise of many frames, and by what it lags.
float weightAfterChange(float changed) { return pow(2.0 / IRRADIANCE_NOISE * changed, 2.0 / 3.0); }
