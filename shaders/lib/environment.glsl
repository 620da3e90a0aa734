// SPDX-License-Identifier: MIT
// Radiance of the surroundings, where rays and cones meet nothing: constant, and with ENVIRONMENT 1 that of a
// latitude-longitude picture besides (light/environment.h). Directions are in world axes.
#ifndef ENVIRONMENT
#define ENVIRONMENT 0
#endif
#include "lib/lighting.glsl"

#if ENVIRONMENT
// Level 0 is the picture; levels of half the size each are means over solid angle.
uniform sampler2D environmentPicture;

const float kEnvironmentTurn = 6.28318530717959;

vec2 environmentUv(vec3 direction) {
    bool upright = direction.x == 0.0 && direction.z == 0.0;
    float azimuth = upright ? 0.0 : atan(direction.x, -direction.z);
    return vec2(azimuth / kEnvironmentTurn + 0.5 + lighting.environmentTurn,
                2.0 * acos(clamp(direction.y, -1.0, 1.0)) / kEnvironmentTurn);
}
#endif

// The mean over about `width` rad.
vec3 skyRadiance(vec3 direction, float width) {
#if ENVIRONMENT
    float level = log2(max(width, 1e-6) / kEnvironmentTurn) + lighting.environmentLevel0;
    vec3 texel = textureLod(environmentPicture, environmentUv(direction), max(level, 0.0)).rgb;
    return lighting.sky + lighting.environmentScale * texel;
#else
    return lighting.sky;
#endif
}
