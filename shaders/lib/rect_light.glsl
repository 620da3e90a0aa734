// SPDX-License-Identifier: MIT
// Rectangular lights of constant radiance.
#include "lib/brdf.glsl"
#include "shared/scene.h"

// Angle between unit vectors a and b, times the component along n of the unit normal of their plane.
float edgeTerm(vec3 a, vec3 b, vec3 n) {
    vec3 c = cross(a, b);
    float sine = length(c);
    float cosine = dot(a, b);
    // angle / sine -> 1 for small angles.
    float angle = sine > 1e-5 ? atan(sine, cosine) / sine : 1.0;
    return angle * dot(c, n);
}

// Irradiance at the origin with normal n per unit radiance of a convex quadrilateral: Lambert's sum over
// edges (Lambert 1760; Baum et al. 1989, "Improving Radiosity Solutions through the Use of Analytically
// Determined Form-Factors", eq. 7), clipped at the horizon. A convex polygon leaves and enters the horizon
// once at most, so the clipped edges plus one edge along the horizon close it.
float polygonIrradiance(vec3 corner[4], vec3 n) {
    vec3 leaves = vec3(0.0), enters = vec3(0.0);
    float sum = 0.0;
    for (int i = 0; i < 4; ++i) {
        vec3 a = corner[i];
        vec3 b = corner[(i + 1) & 3];
        float ha = dot(a, n), hb = dot(b, n);
        bool aAbove = ha > 0.0, bAbove = hb > 0.0;
        // Where the edge crosses the horizon, if it does.
        vec3 crossing = a + (b - a) * (ha / (aAbove != bAbove ? ha - hb : 1.0));
        if (aAbove && !bAbove) leaves = crossing;
        if (!aAbove && bAbove) enters = crossing;
        vec3 from = aAbove ? a : crossing;
        vec3 to = bAbove ? b : crossing;
        float term = edgeTerm(normalize(from), normalize(to), n);
        sum += aAbove || bAbove ? term : 0.0;
    }
    bool clipped = dot(leaves, leaves) > 0.0 && dot(enters, enters) > 0.0;
    sum += clipped ? edgeTerm(normalize(leaves), normalize(enters), n) : 0.0;
    return 0.5 * abs(sum);  // the sign is that of the edges' turn
}

void rectCorners(Light light, vec3 p, out vec3 corner[4]) {
    vec3 c = light.position - p;
    corner[0] = c - light.halfU - light.halfV;
    corner[1] = c + light.halfU - light.halfV;
    corner[2] = c + light.halfU + light.halfV;
    corner[3] = c - light.halfU + light.halfV;
}

// Irradiance at p with normal n per unit radiance; the light has one shining side.
float rectIrradiance(Light light, vec3 p, vec3 n) {
    vec3 corner[4];
    rectCorners(light, p, corner);
    return dot(p - light.position, light.direction) > 0.0 ? polygonIrradiance(corner, n) : 0.0;
}

// Widening of alpha^2 per steradian of a cell: least error of 4 x 4 cells for roughness 0.5 to 0.8 against a
// sum over 100 x 100, three lights over a floor (2026-11).
const float kRectCellWidening = 0.25;

// The lobe without Fresnel's factor, averaged over a cell of solid angle `solidAngle` around `toLight`:
// widened by the cell's extent, keeping its energy.
float rectCellLobe(Brdf b, vec3 n, vec3 toLight, vec3 toEye, float solidAngle) {
    float alpha = sqrt(min(b.alpha * b.alpha + kRectCellWidening * solidAngle, 1.0));
    vec3 h = normalize(toLight + toEye);
    float noh = clamp(dot(n, h), 0.0, 1.0);
    float nol = clamp(dot(n, toLight), 1e-4, 1.0);
    return ggxVisible(alpha, noh, nol, b.nov);
}

// Unshadowed reflection towards the eye per unit radiance. Smooth surfaces: the lobe around the mirror
// direction is taken as a clamped cosine stretched by the lobe's width, for which the integral over a polygon
// is closed (linearly transformed cosines, Heitz et al. 2016). Their stretch is fitted; ours follows from GGX
// for small alpha, where reflection doubles the angle of the half vector: 2 alpha in the plane of incidence
// and 2 alpha NoV across; for larger alpha the corrections below are fitted. Rough surfaces: the sum over
// cells
// (`cellSum`, without Fresnel's factor). Error against 100 x 100 cells, RMS over mean, of three lights over a
// floor: roughness 0.1: 2 %, 0.2: 10 %, 0.3: 19 %, 0.5: 23 %, 0.8: 7 %; a sum over 4 x 4 cells alone has 200
// % at 0.1.
vec3 rectSpecular(Light light, vec3 p, vec3 n, vec3 toEye, Brdf b, float cellSum) {
    // The lobe leans from the mirror direction towards the normal.
    vec3 mirror = 2.0 * dot(n, toEye) * n - toEye;
    float a2 = b.alpha * b.alpha;
    vec3 axis = normalize(mix(mirror, n, min(2.25 * a2, 0.9)));
    vec3 across = cross(n, axis);
    float acrossLength = length(across);
    across = acrossLength > 1e-4 ? across / acrossLength : normalize(cross(n.yzx, n) + vec3(1e-6));
    vec3 along = cross(across, axis);
    float width = (2.0 - b.alpha) * b.alpha;
    float widthAcross = clamp(width * max(max(dot(axis, n), 0.02), 0.5 * b.alpha), 1e-5, 1.0);

    vec3 corner[4];
    rectCorners(light, p, corner);
    for (int i = 0; i < 4; ++i)
        corner[i] = vec3(dot(corner[i], along) / min(width, 1.0), dot(corner[i], across) / widthAcross,
                         dot(corner[i], axis));
    float stretched = polygonIrradiance(corner, vec3(0.0, 0.0, 1.0)) / kPi;

    // From one to the other where both err by the same, at roughness 0.45 to 0.75.
    vec3 smoothSurface = b.albedo * stretched;
    vec3 roughSurface =
        fresnel(b.f0, b.f90, clamp(dot(toEye, normalize(axis + toEye)), 0.0, 1.0)) * b.compensation * cellSum;
    return mix(smoothSurface, roughSurface, smoothstep(0.45, 0.75, sqrt(b.alpha)));
}
