// SPDX-License-Identifier: MIT
// Where the sample points of an area light lie. Of a rectangle in [-1,1] along halfU and halfV: 16, the default,
// where shared/rect_points.h says; another number, grid^2, one per cell of a grid, at places that differ in
// both coordinates (Chiu et al. 1994, "Multi-Jittered Sampling", without the jitter). Round ones: 16 by the same
// header; other numbers by a lattice on the sphere of four dimensions. C++ twin:
// rectSamplePoint in src/light/shadow_layout.cpp.
// LIGHTS_SHAPED 0: no light is round.
#ifndef LIGHTS_SHAPED
#define LIGHTS_SHAPED 1
#endif
#include "lib/dot.glsl"
#include "shared/rect_points.h"
#include "shared/scene.h"

vec2 rectPointPlace(uint k, uint grid) {
    uint count = grid * grid;
    uint row = count == RECT_POINT_COUNT ? RECT_POINT_ROW(k) : (k % grid) * grid + k / grid;
    return (vec2(k, row) + 0.5) * (2.0 / float(count)) - 1.0;
}

bool isRound(Light light) {
#if LIGHTS_SHAPED
    return (light.flags & (LIGHT_DISK | LIGHT_SPHERE)) != 0u;
#else
    return false;
#endif
}

bool isSphere(Light light) {
#if LIGHTS_SHAPED
    return (light.flags & LIGHT_SPHERE) != 0u;
#else
    return false;
#endif
}

#if LIGHTS_SHAPED
// In the unit sphere; x and y alone in the unit disc.
vec3 roundPointPlace(uint k, uint count) {
    if (count == ROUND_POINT_COUNT) return unpackSnorm4x8(kRoundPoints[k]).xyz;
    // Roberts 2018, "The Unreasonable Effectiveness of Quasirandom Sequences", by three numbers.
    vec3 t = fract((float(k) + 0.5) * vec3(0.8191725, 0.6710436, 0.5497005));
    t.yz *= 6.2831853;
    float r = sqrt(1.0 - t.x);
    return vec3(r * cos(t.y), r * sin(t.y), sqrt(t.x) * cos(t.z));
}
#endif

// Of the k-th point, from the middle of the light.
vec3 rectPointOffset(Light light, uint k) {
#if LIGHTS_SHAPED
    if (isRound(light)) {
        vec3 at = roundPointPlace(k, light.sampleGrid * light.sampleGrid);
        vec3 inDisc = at.x * light.halfU + at.y * light.halfV;
        return isSphere(light) ? inDisc + (at.z * length(light.halfU)) * light.direction : inDisc;
    }
#endif
    vec2 at = rectPointPlace(k, light.sampleGrid);
    return at.x * light.halfU + at.y * light.halfV;
}

// m^2; of a sphere that of its disc.
float rectArea(Light light) {
    return (isRound(light) ? 3.14159265 : 4.0) * length(cross(light.halfU, light.halfV));
}

// Cosine between the unit vector l towards the light and the shining side; a sphere looks the same from everywhere.
float rectCosine(Light light, vec3 l) { return isSphere(light) ? 1.0 : max(-dot(l, light.direction), 0.0); }
