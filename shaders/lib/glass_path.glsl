// SPDX-License-Identifier: MIT
// Paths through glass: facets of a surface, and what a path is behind it. Includers set GLASS and include
// before: lib/scene_tables.glsl, lib/surface_array.glsl. Refraction at facets: Walter and others 2007,
// "Microfacet Models for Refraction through Rough Surfaces". C++ twin of the surface: reference/materials.cpp.
#include "lib/dot.glsl"
#include "lib/ggx_sample.glsl"
#include "lib/glass_tree.glsl"

struct GlassPath {
    vec3 origin;
    vec3 direction;
    vec3 throughput;
    vec3 absorption;  // of the solid that the path is in, 1/m
    float alpha;      // width of all lobes on the way, but of smooth surfaces
    bool bent;        // has left the line of sight
    bool narrow;      // its last lobe shows lamps by rays, not by highlights
};

// A facet's normal that the eye sees.
vec3 glassFacet(GlassSurface s, vec3 toEye, vec2 xi) {
    vec3 u, v;
    tangentFrame(s.normal, u, v);
    vec3 eye = normalize(vec3(dot(toEye, u), dot(toEye, v), s.brdf.NoV));
    vec3 h = visibleNormal(eye, s.brdf.alpha, xi);
    return h.x * u + h.y * v + h.z * s.normal;
}

// Share of the facets seen by the eye that are seen at this height on the other end too.
float facetsSeen(GlassSurface s, float height) {
    float eye = smithLambda(s.brdf.alpha, s.brdf.NoV);
    return (1.0 + eye) / (1.0 + eye + smithLambda(s.brdf.alpha, height));
}

// Share of light that a facet reflects, by Schlick's cosine in air; 1 beyond the critical angle.
vec3 facetFresnel(GlassSurface s, float VoH, float eta) {
    float sine2 = (1.0 - VoH * VoH) / (eta * eta);
    float cosine = s.back ? sqrt(max(1.0 - sine2, 0.0)) : VoH;
    return sine2 >= 1.0 ? vec3(1.0) : fresnel(s.brdf.f0, s.brdf.f90, cosine);
}

// The path goes through a surface, at a facet with normal h.
void passThrough(inout GlassPath path, GlassSurface s, vec3 h) {
    if (passesStraight(s)) {
        path.throughput *= s.through;
        return;
    }
    vec3 toEye = -path.direction;
    float VoH = clamp(dot(toEye, h), 0.0, 1.0);
    path.narrow = path.bent = true;
    if (!isSmooth(s)) path.alpha = sqrt(path.alpha * path.alpha + s.brdf.alpha * s.brdf.alpha);
    vec2 lobe = directionalAlbedo(s.brdf.NoV, sqrt(s.brdf.alpha));
    if (!s.solid) {
        // Into the mirror image of the lobe of facets that reflect all.
        vec3 l = 2.0 * VoH * h - toEye;
        float above = dot(l, s.normal);
        path.throughput *= above > 0.0 ? s.through / (lobe.x + lobe.y) * facetsSeen(s, above) : vec3(0.0);
        path.direction = l - 2.0 * above * s.normal;
        return;
    }
    float eta = s.back ? 1.0 / s.ior : s.ior;
    vec3 reflected = facetFresnel(s, VoH, eta);
    float cosine2 = 1.0 - (1.0 - VoH * VoH) / (eta * eta);
    vec3 l = (VoH / eta - sqrt(max(cosine2, 0.0))) * h - toEye / eta;
    // Facets in each other's shadow lose light that others catch.
    vec3 mean = lobe.x + lobe.y - (s.brdf.f0 * lobe.x + s.brdf.f90 * lobe.y);
    vec3 front = s.through / max(mean, vec3(1e-3)) * (1.0 - reflected) * facetsSeen(s, -dot(l, s.normal));
    path.throughput *= s.back ? s.tint * (1.0 - reflected) : front;
    path.direction = normalize(l);
}
