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

// Irradiance at p with normal n per unit radiance of the rectangle: Lambert's sum over edges (Lambert 1760;
// Baum et al. 1989, "Improving Radiosity Solutions through the Use of Analytically Determined Form-Factors",
// eq. 7), of the polygon clipped at the horizon. A convex polygon leaves and enters the horizon once at most,
// so the clipped edges plus one edge along the horizon close it.
float rectIrradiance(Light light, vec3 p, vec3 n) {
    vec3 corner[4];
    corner[0] = light.position - light.halfU - light.halfV - p;
    corner[1] = light.position + light.halfU - light.halfV - p;
    corner[2] = light.position + light.halfU + light.halfV - p;
    corner[3] = light.position - light.halfU + light.halfV - p;
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
    // The front only. The sign of the sum is that of the edges' turn, seen from p.
    bool front = dot(p - light.position, light.direction) > 0.0;
    return front ? 0.5 * abs(sum) : 0.0;
}

// Widening of alpha^2 per steradian of a cell, chosen by measurement (tests/shader/rect_light_test.cpp).
const float kRectCellWidening = 0.16;

// The specular BRDF averaged over a cell of a rectangle, of solid angle `solidAngle` around `toLight`: the
// lobe is widened by the cell's extent, keeping its energy.
vec3 rectCellSpecular(Brdf b, vec3 n, vec3 toLight, vec3 toEye, float solidAngle) {
    b.alpha = sqrt(clamp(b.alpha * b.alpha + kRectCellWidening * solidAngle, 0.0, 1.0));
    return brdfSpecular(b, n, toLight, toEye);
}
