// SPDX-License-Identifier: MIT
// The bits of the G-buffer: two texels of four words per pixel.
//
//   geometry  x  view depth, float bits; 0: background
//             y  shading normal, octahedral, 2 x 16 bit signed
//             z  geometric normal, likewise; both face the eye
//             w  spread of normals, 6 bit square root << 26 | instance index << 2 | unlit << 1 | back-facing
//   material  x  albedo r, g, 16 bit each
//             y  albedo b, perceptual roughness, 16 bit each
//                unlit: radiance r, g, b, 16 bit each, and 16 bit of exponent in the roughness's place
//             z  dielectric F0 r, g, b as 8 bit square roots (0.2 of the default 0.04 is exact); metallic 8
//             bit w  factor on the material's emission, 10 bit square roots; 0 on the dark side of an emitter
// Emission itself stays in the material table in full precision: untextured emitters show it exactly.

uint packInstanceWord(uint instance, bool unlit) { return (instance << 2) | (unlit ? 2u : 0u); }
uint instanceOfWord(uint word) { return word >> 2 & 0xffffffu; }

// How far the length of the mean of a pixel's normals is below 1; finer where it is small.
uint packSpread(float spread) { return uint(round(sqrt(clamp(spread, 0.0, 1.0)) * 63.0)) << 26; }
float spreadOfWord(uint word) {
    float root = float(word >> 26) * (1.0 / 63.0);
    return root * root;
}

// Radiance of an unlit surface, which may be far above 1 (baked light): parts of a power of two not below the
// largest channel. Its exponent stands 64 up, so that 0 is free for black.
uvec2 packUnlit(vec3 radiance) {
    vec3 c = clamp(radiance, 0.0, 1e18);
    float exponent = clamp(ceil(log2(max(max(c.r, c.g), max(c.b, 1e-18)))), -60.0, 60.0);
    c *= exp2(-exponent);
    return uvec2(packUnorm2x16(c.rg), packUnorm2x16(vec2(c.b, 0.0)) | (uint(exponent + 64.0) << 16));
}
float unlitScale(uint word) { return exp2(float(word >> 16) - 64.0); }

uint packReflectance(vec3 dielectricF0, float metallic) {
    return packUnorm4x8(vec4(sqrt(max(dielectricF0, vec3(0.0))), metallic));
}
void unpackReflectance(uint bits, out vec3 dielectricF0, out float metallic) {
    vec4 v = unpackUnorm4x8(bits);
    dielectricF0 = v.rgb * v.rgb;
    metallic = v.a;
}

uint packEmissionFactor(vec3 factor) {
    uvec3 v = uvec3(round(sqrt(clamp(factor, 0.0, 1.0)) * 1023.0));
    return v.r | (v.g << 10) | (v.b << 20);
}
vec3 unpackEmissionFactor(uint bits) {
    vec3 v = vec3(bits & 1023u, (bits >> 10) & 1023u, (bits >> 20) & 1023u) * (1.0 / 1023.0);
    return v * v;
}
