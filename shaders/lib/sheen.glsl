// SPDX-License-Identifier: MIT
// The sheen of cloth (Estevez and Kulla 2017, "Production Friendly Microfacet Sheen BRDF"). C++ twin: src/math/sheen.h,
// whose comments hold the method.
#include "lib/brdf.glsl"
#include "lib/dot.glsl"
uniform sampler2D sheenTable;  // directional albedo: math::sheenTable

const float kMinSheenRoughness = 0.07;

float sheenExponent(float cosine, float alpha) {
    float t = (1.0 - alpha) * (1.0 - alpha);
    float a = mix(21.5473, 25.3245, t), b = mix(3.82987, 3.32435, t);
    float c = mix(0.19823, 0.16801, t), d = mix(-1.97760, -1.27393, t);
    float e = mix(-4.32054, -4.85967, t);
    return a / (1.0 + b * pow(cosine, c)) + d * cosine + e;
}

float sheenLambda(float cosine, float alpha) {
    bool low = cosine < 0.5;
    float exponent = sheenExponent(low ? cosine : 1.0 - cosine, alpha);
    return exp(low ? exponent : 2.0 * sheenExponent(0.5, alpha) - exponent);
}

// The term times the cosine to the light, 1/sr, for unit vectors.
float sheenTimesCosine(vec3 normal, float roughness, vec3 toLight, vec3 toEye) {
    float r = clamp(roughness, kMinSheenRoughness, 1.0);
    float alpha = r * r;
    float NoL = dot(normal, toLight);
    float NoV = max(dot(normal, toEye), 1e-4);
    float NoH = dot(normal, normalize(toLight + toEye));
    float sine2 = max(1.0 - NoH * NoH, 1e-7);
    float distribution = (2.0 + 1.0 / alpha) * pow(sine2, 0.5 / alpha) / (2.0 * kPi);
    float masking = 1.0 + sheenLambda(clamp(NoL, 1e-4, 1.0), alpha) + sheenLambda(min(NoV, 1.0), alpha);
    return NoL > 0.0 ? distribution / (4.0 * NoV * masking) : 0.0;
}

// Of white sheen: its factor on the term, and the share of light that it sends to the eye.
vec2 sheenShare(float NoV, float roughness) {
    vec2 at =
        vec2(sqrt(clamp(NoV, 0.0, 1.0)),
             (clamp(roughness, kMinSheenRoughness, 1.0) - kMinSheenRoughness) / (1.0 - kMinSheenRoughness));
    vec2 size = vec2(textureSize(sheenTable, 0));
    float albedo = textureLod(sheenTable, (at * (size - 1.0) + 0.5) / size, 0.0).r;
    float most = max(albedo, 1.0);
    return vec2(1.0, albedo) / most;
}
