// SPDX-License-Identifier: MIT
// Directions of the GGX lobe drawn by the visible normals (Heitz 2018, "Sampling the GGX Distribution of
// Visible Normals"), and what a ray in such a direction weighs: docs/theory/4f_glossy.md, (4.33).
#include "lib/brdf.glsl"
#include "lib/dot.glsl"
#include "lib/tangent_frame.glsl"

// A microfacet normal seen from `toEye`; both in the frame whose z is the surface's normal.
vec3 visibleNormal(vec3 toEye, float alpha, vec2 xi) {
    vec3 v = normalize(vec3(alpha * toEye.xy, toEye.z));
    float l2 = dot(v.xy, v.xy);
    vec3 t1 = l2 > 1e-12 ? vec3(-v.y, v.x, 0.0) * inversesqrt(l2) : vec3(1.0, 0.0, 0.0);
    vec3 t2 = cross(v, t1);
    float r = sqrt(xi.x);
    float phi = 2.0 * kPi * xi.y;
    float a = r * cos(phi);
    float s = 0.5 * (1.0 + v.z);
    float b = mix(sqrt(max(1.0 - a * a, 0.0)), r * sin(phi), s);
    vec3 n = a * t1 + b * t2 + sqrt(max(1.0 - a * a - b * b, 0.0)) * v;
    return normalize(vec3(alpha * n.xy, max(n.z, 1e-6)));
}

// Smith's Lambda of GGX for a direction of height z.
float smithLambda(float alpha, float z) {
    float z2 = z * z;
    return 0.5 * (sqrt(1.0 + alpha * alpha * (1.0 - z2) / max(z2, 1e-8)) - 1.0);
}

// Density per steradian with which lobeDirection draws the direction `toLight`.
float lobePdf(Brdf b, vec3 normal, vec3 toEye, vec3 toLight) {
    float a2 = b.alpha * b.alpha;
    float NoH = clamp(dot(normal, normalize(toEye + toLight)), 0.0, 1.0);
    float d = NoH * NoH * (a2 - 1.0) + 1.0;
    return a2 / (kPi * d * d) / (1.0 + smithLambda(b.alpha, b.NoV)) / (4.0 * b.NoV);
}

// BRDF times cosine over lobePdf, for a direction of height NoL that meets its facets at the cosine VoH; 0 below the
// surface.
vec3 lobeWeight(Brdf b, float NoL, float VoH) {
    float lambdaEye = smithLambda(b.alpha, b.NoV);
    float shadowing = (1.0 + lambdaEye) / (1.0 + lambdaEye + smithLambda(b.alpha, NoL));
    return NoL > 0.0 ? fresnel(b.f0, b.f90, VoH) * b.compensation * shadowing : vec3(0.0);
}

// A direction of the lobe of b about `normal`, seen from `toEye`; weight: its share of radiance, 0 where the
// facet mirrors into the surface.
vec3 lobeDirection(Brdf b, vec3 normal, vec3 toEye, vec2 xi, out vec3 weight) {
    vec3 u, v;
    tangentFrame(normal, u, v);
    vec3 eye = normalize(vec3(dot(toEye, u), dot(toEye, v), b.NoV));
    vec3 h = visibleNormal(eye, b.alpha, xi);
    float VoH = max(dot(eye, h), 0.0);
    vec3 l = 2.0 * VoH * h - eye;
    weight = lobeWeight(b, l.z, VoH);
    return l.x * u + l.y * v + l.z * normal;
}
