// SPDX-License-Identifier: MIT
// The BRDF of glTF 2.0 metallic-roughness (its appendix B): Lambert plus one GGX lobe (Trowbridge-Reitz,
// Walter et al. 2007) with height-correlated Smith masking (Heitz 2014) and Schlick's Fresnel.
//
// Energy: a single-scattering GGX lobe loses what bounces more than once between the facets, up to 60 % of
// it. The lobe is scaled by 1 + F0 (1/E - 1), E its directional albedo at F = 1 (Turquin 2019, "Practical
// multiple scattering compensation for microfacet models"), and the diffuse part of a dielectric gets what
// the lobe leaves: 1 - its directional albedo. So a white surface, metal or dielectric, returns all light of
// a white furnace (docs/theory/3_light.md). C++ twin: src/math/brdf.h. Limits: not reciprocal in both
// corrections.
#include "lib/dot.glsl"

const float kPi = 3.14159265358979;

// Roughness below this shows a highlight of less than a pixel that only makes noise; alpha = 0.045^2 = 0.002.
const float kMinRoughness = 0.045;

// What the functions below need to know of a surface seen from one direction.
struct Brdf {
    vec3 diffuse;  // directional albedo of the diffuse part: radiance = diffuse / pi * irradiance
    vec3 f0;
    vec3 f90;
    vec3 compensation;  // factor on the specular lobe
    vec3 albedo;        // directional albedo of the specular lobe, compensation included
    float alpha;        // GGX width
    float NoV;
    bool ideal;  // a mirror, which shows nothing of lamps without extent
};

// Directional albedo of the single-scattering lobe for F0 = 1, F90 = 0 (x) and F0 = 0, F90 = 1 (y), so that
// it is F0 x + F90 y with Schlick's Fresnel. Polynomials fitted by us (2026-11) to a quadrature over the
// visible normals (Heitz 2018) for NoV in [0.005, 1] and perceptual roughness in [0.045, 1]; largest error of
// x + y 0.6 percent of it, of y 0.0026. `roughness` is perceptual.
vec2 directionalAlbedo(float NoV, float roughness) {
    float a = roughness * roughness;
    float s = NoV / (NoV + a);  // facets hide each other at grazing angles by the ratio of these two
    float both =
        (0.959575 + s * (0.438832 + s * (-3.25298 + s * (5.54518 + s * -2.68982)))) +
        a * ((0.285436 + s * (-3.13559 + s * (10.8832 + s * (-14.5516 + s * 6.2423)))) +
             a * ((-0.689624 + s * (1.98606 + s * (-7.77566 + s * (1.51046 + s * 9.55351)))) +
                  a * ((0.645843 + s * (-3.86254 + s * (10.699 + s * (-2.09599 + s * -18.0685)))) +
                       a * (-0.217635 + s * (1.4135 + s * (-1.41486 + s * (-8.25343 + s * 18.5846)))))));
    float r = roughness;
    float c = 1.0 - NoV;
    float grazing =
        (1.2406 + s * (-0.0343653 + s * (-3.78446 + s * (6.60108 + s * -3.02584)))) +
        r * ((-4.05669 + s * (0.801049 + s * (20.2115 + s * (-18.1767 + s * 1.51945)))) +
             r * ((5.47252 + s * (-6.02894 + s * (-3.47122 + s * (-77.448 + s * 73.214)))) +
                  r * ((-3.45332 + s * (9.0266 + s * (-24.3157 + s * (120.581 + s * -45.8689)))) +
                       r * (0.843674 + s * (-3.97724 + s * (13.7924 + s * (-43.6449 + s * -1.62864)))))));
    both = clamp(both, 0.0, 1.0);
    grazing = clamp(grazing * (c * c) * (c * c) * c, 0.0, both);
    return vec2(both - grazing, grazing);
}

// Schlick's approximation.
vec3 fresnel(vec3 f0, vec3 f90, float VoH) {
    float c = 1.0 - VoH;
    float c2 = c * c;
    return f0 + (f90 - f0) * (c2 * c2 * c);
}

// Light in a room is not even: much of it comes steeply, of which a lobe reflects half the mean or less, and
// what it reflects of grazing light goes on much as if nothing had been there. Fitted to builtin:spheres and
// builtin:lobby, whose indirect light is 3.3 and 1.6 % too dark with 0, 1.9 and 2.0 % too bright with 1.
const float kEvenLobe = 0.5;

// Rays know two kinds of surfaces: dielectrics of this reflectance, and metals.
const float kDielectricF0 = 0.04;

// A surface as rays are told of it: a dielectric that reflects more counts as partly metal, so that its body and its lobe
// reflect what they did.
struct MetallicSurface {
    vec3 baseColor;
    float metallic;
    vec3 dielectricF0;
};

// C++ twin: math::metallicSurface.
MetallicSurface metallicSurface(vec3 baseColor, float metallic, vec3 dielectricF0) {
    vec3 more = max(dielectricF0 - (kDielectricF0 + 1e-4), 0.0);
    if (more.r + more.g + more.b == 0.0) return MetallicSurface(baseColor, metallic, dielectricF0);
    float strongest = max(dielectricF0.r, max(dielectricF0.g, dielectricF0.b));
    vec3 body = baseColor * ((1.0 - strongest) / (1.0 - kDielectricF0));
    float ofBody = body.r + body.g + body.b;
    // The lobe of the metal is what the dielectric's part of it does not reflect; twice, as that part depends on it.
    float metal = (more.r + more.g + more.b) / (more.r + more.g + more.b + ofBody);
    more = max(dielectricF0 - (1.0 - metal) * kDielectricF0, 0.0);
    metal = (more.r + more.g + more.b) / (more.r + more.g + more.b + ofBody);
    vec3 color = min(body + max(dielectricF0 - (1.0 - metal) * kDielectricF0, 0.0), 1.0);
    return MetallicSurface(mix(color, baseColor, metallic), mix(metal, 1.0, metallic),
                           min(dielectricF0, kDielectricF0));
}

// Metalness and roughness as rays are told them: a dielectric that reflects nothing has no lobe, as a rough one.
vec2 toldLobe(vec3 baseColor, float metallic, float roughness, vec3 dielectricF0) {
    bool reflects = metallic > 0.0 || max(dielectricF0.r, max(dielectricF0.g, dielectricF0.b)) > 0.0;
    return vec2(metallicSurface(baseColor, metallic, dielectricF0).metallic, reflects ? roughness : 1.0);
}

// Share of even light that the lobe of a dielectric is counted with (kEvenLobe), multiple scattering included.
vec3 evenLobe(float roughness, vec3 dielectricF0) {
    float r = max(roughness, kMinRoughness);
    float both = 0.9997027 + r * (-0.01521229 + r * (0.3516476 + r * (-2.2508005 + r * 1.3269485)));
    float grazing = 0.04557508 + r * (0.05997143 + r * (-0.4956394 + r * (0.670405 + r * -0.2784238)));
    float f0 = max(dielectricF0.r, max(dielectricF0.g, dielectricF0.b));
    float f90 = clamp(50.0 * f0, 0.0, 1.0);
    vec3 own = (dielectricF0 * (both - grazing) + f90 * grazing) * (1.0 + dielectricF0 * (1.0 / both - 1.0));
    return own * kEvenLobe;
}

// Share of the light that a surface sends back on average, for what knows surfaces by one colour only. In
// even light a dielectric reflects base + (1 - base) R: its own lobe, and the base what that leaves
// (makeBrdf). R is the mean of specularAlbedo over the hemisphere, from means of directionalAlbedo by
// polynomials (2026-11; largest error of R at F0 = 0.04: 0.002): 0.04 at roughness 0.65, 0.09 when smooth.
// Metals count with their base colour: their lobe is added where rays meet them. docs/theory/4f_glossy.md,
// (4.35). C++ twin: math::evenAlbedo.
vec3 evenAlbedo(vec3 baseColor, float metallic, float roughness, vec3 dielectricF0) {
    MetallicSurface told = metallicSurface(baseColor, metallic, dielectricF0);
    vec3 own = evenLobe(roughness, told.dielectricF0);
    float strongest = max(own.r, max(own.g, own.b));
    return mix(told.baseColor * (1.0 - strongest) + own, told.baseColor, told.metallic);
}

// The same of a surface with coat and sheen; `evenLayers`: of its Material. C++ twin: math::LayerAlbedo.
vec3 layeredAlbedo(vec3 albedo, uint evenLayers) {
    vec4 v = unpackUnorm4x8(evenLayers);
    v *= v;
    return albedo * (1.0 - v.a) + v.rgb;
}

// The base colour of a dielectric of F0 = 0.04 that has this albedo.
vec3 baseOfEvenAlbedo(vec3 albedo, float roughness) {
    float own = evenLobe(roughness, vec3(0.04)).r;
    return clamp((albedo - own) / (1.0 - own), 0.0, 1.0);
}

// Share of specularly reflected light of a white furnace, multiple scattering included; `dfg` is
// directionalAlbedo of the surface.
vec3 specularAlbedo(Brdf b, vec2 dfg) { return (b.f0 * dfg.x + b.f90 * dfg.y) * b.compensation; }

Brdf makeBrdf(vec3 baseColor, float metallic, float roughness, vec3 dielectricF0, float NoV) {
    Brdf b;
    b.NoV = clamp(NoV, 1e-4, 1.0);
    float r = max(roughness, kMinRoughness);
    b.alpha = r * r;
    b.ideal = roughness < kMinRoughness - 1e-5;
    b.f0 = mix(dielectricF0, baseColor, metallic);
    // No material reflects less than 2 % at normal incidence but by intent (KHR_materials_specular): then its
    // grazing reflection goes as well.
    b.f90 = vec3(clamp(50.0 * max(b.f0.r, max(b.f0.g, b.f0.b)), 0.0, 1.0));
    vec2 dfg = directionalAlbedo(b.NoV, r);
    b.compensation = 1.0 + b.f0 * (1.0 / (dfg.x + dfg.y) - 1.0);
    b.albedo = specularAlbedo(b, dfg);
    // The dielectric's own lobe decides what reaches the diffuse part, by its strongest channel, so that a
    // tinted lobe does not tint the base.
    float f0 = max(dielectricF0.r, max(dielectricF0.g, dielectricF0.b));
    float f90 = clamp(50.0 * f0, 0.0, 1.0);
    float reflected = (f0 * dfg.x + f90 * dfg.y) * (1.0 + f0 * (1.0 / (dfg.x + dfg.y) - 1.0));
    b.diffuse = baseColor * ((1.0 - metallic) * clamp(1.0 - reflected, 0.0, 1.0));
    return b;
}

// GGX times visibility, D V = D G2 / (4 NoL NoV).
float ggxVisible(float alpha, float NoH, float NoL, float NoV) {
    float a2 = alpha * alpha;
    // 1 - NoH^2 (1 - a2) by the complement keeps its digits near the peak.
    float d = (1.0 - NoH * NoH) + NoH * NoH * a2;
    float smithV = NoL * sqrt(NoV * NoV * (1.0 - a2) + a2);
    float smithL = NoV * sqrt(NoL * NoL * (1.0 - a2) + a2);
    return a2 / (kPi * d * d) * 0.5 / max(smithV + smithL, 1e-7);
}

// The specular BRDF (1/sr) for unit vectors to the light and to the eye.
vec3 brdfSpecular(Brdf b, vec3 n, vec3 toLight, vec3 toEye) {
    vec3 h = normalize(toLight + toEye);
    float VoH = clamp(dot(toEye, h), 0.0, 1.0);
    float NoH = clamp(dot(n, h), 0.0, 1.0);
    float NoL = clamp(dot(n, toLight), 1e-4, 1.0);
    return fresnel(b.f0, b.f90, VoH) * b.compensation * ggxVisible(b.alpha, NoH, NoL, b.NoV);
}
