#version 450 core
// SPDX-License-Identifier: MIT
// Fragments of the scene -> the G-buffer's words (lib/gbuffer_pack.glsl). Material model of glTF 2.0 with
// KHR_texture_transform, _specular, _unlit; MASKED: discards below the cut-off of masked materials, and below
// thresholds of blended ones (FrameConstants::blending; Enderton et al. 2010, "Stochastic Transparency").
#ifndef TEXTURES
#error TEXTURES must be 0 (none), 1 (base colour) or 2 (all)
#endif
#ifndef MASKED
#error MASKED must be 0 or 1
#endif
#include "lib/dot.glsl"
#include "lib/frame_block.glsl"
#include "lib/gbuffer_pack.glsl"
#include "lib/octahedral.glsl"
#include "lib/random.glsl"
#include "lib/scene_tables.glsl"
#if TEXTURES >= 1
#include "lib/texture_filter.glsl"
#endif

layout(location = 0) in vec3 fromEye;
layout(location = 1) in vec3 interpolatedNormal;
layout(location = 2) in vec4 interpolatedBase;
layout(location = 3) flat in uvec4 constant;
#if TEXTURES >= 1
layout(location = 4) in vec2 uv;
uniform sampler2D baseTexture;
#endif
#if TEXTURES >= 2
layout(location = 5) in vec4 interpolatedTangent;
uniform sampler2D metalRoughTexture;
uniform sampler2D normalTexture;
uniform sampler2D emissiveTexture;
uniform sampler2D specularTexture;
uniform sampler2D specularColorTexture;
#endif

layout(location = 0) out uvec4 outGeometry;
layout(location = 1) out uvec4 outMaterial;

#if TEXTURES >= 1
// Texel of the use-th texture (order of Material::uvRow). The gradients come from the interpolated uv: helper
// invocations beside the triangle may read zeros from the material table (Mesa's software driver does), so
// that implicit ones are wrong along every edge.
vec4 materialTexel(sampler2D map, uint material, int use, out TexelFootprint footprint) {
    vec3 row0 = materials[material].uvRow[2 * use].xyz;
    vec3 row1 = materials[material].uvRow[2 * use + 1].xyz;
    mat2 turn = mat2(row0.x, row1.x, row0.y, row1.y);
    vec2 at = turn * uv + vec2(row0.z, row1.z);
    footprint = texelFootprint(map, frame.footprint * (turn * dFdx(uv)), frame.footprint * (turn * dFdy(uv)));
    return filteredTexel(map, at, footprint);
}
vec4 materialTexel(sampler2D map, uint material, int use) {
    TexelFootprint footprint;
    return materialTexel(map, material, use, footprint);
}
#endif

#if TEXTURES >= 2
// How far the length of the mean of normals is below 1, where a footprint covers several texels.
float normalSpread(vec3 mean, float scale, TexelFootprint footprint) {
    float several = clamp(footprint.longer - 1.0, 0.0, 1.0);
    return clamp(several * scale * scale * (1.0 - UNIT_NORMAL_ROUNDING - length(mean)), 0.0, 0.9);
}

// Perceptual roughness with that of the spread of normals. The spread is that of a von Mises-Fisher lobe (Banerjee and
// others 2005), whose slopes vary by 1 / concentration along each axis; squared widths of lobes add up (Toksvig 2005,
// "Mipmapping Normal Maps").
float spreadRoughness(float roughness, float spread) {
    float mean = 1.0 - spread;
    float variance = (1.0 - mean * mean) / (3.0 * mean - mean * mean * mean);
    float alpha = roughness * roughness;
    return sqrt(sqrt(min(alpha * alpha + 2.0 * variance, 1.0)));
}
#endif

// From the eye to the surface, or along parallel rays.
vec3 sight() { return frame.parallel != 0.0 ? frame.viewForward : fromEye; }

float viewDepth() { return frame.parallel != 0.0 ? dot(fromEye, frame.viewForward) : 1.0 / gl_FragCoord.w; }

// The normal of the triangle, towards the eye.
vec3 faceNormal() {
    vec3 n = cross(dFdx(fromEye), dFdy(fromEye));
    float len = length(n);
    // Slivers without extent on screen have none of their own.
    n = len > 0.0 ? n / len : normalize(interpolatedNormal);
    return dot(n, sight()) > 0.0 ? -n : n;
}

#if MASKED
// Above 0, so that what hides nothing is not there, and at most 1.
float blendThreshold() {
    if (frame.blending < 0.0) return 0.5;
    uvec2 pixel = uvec2(gl_FragCoord.xy);
    if (frame.blending >= 2.0) return (float(pixel.x % 3u + 3u * (pixel.y % 3u)) + 0.5) / 9.0;
    // Within the views' steps pixels differ by an ordered pattern (Bayer 1973). Where the steps begin is random, so
    // that layers are independent of each other.
    float steps = round(1.0 / (frame.footprint * frame.footprint));
    uint bits = randomHash(pixel.x | pixel.y << 16) ^ randomHash(constant.x >> 2);
    uvec2 fine = pixel & 1u, coarse = pixel >> 1 & 1u;
    uint order = (fine.x ^ fine.y) << 3 | fine.y << 2 | (coarse.x ^ coarse.y) << 1 | coarse.y;
    float within = (float(order) + 0.5) / 16.0;
    return 1.0 - fract((floor(randomFloat(randomHash(bits)) * steps) + within) / steps + frame.blending);
}
#endif

void main() {
    uint material = constant.z;
    vec4 base = interpolatedBase;
    float roughness = uintBitsToFloat(constant.w);
    uint reflectance = constant.y;
    vec3 emissionFactor = vec3(1.0);
#if TEXTURES >= 1
    base *= materialTexel(baseTexture, material, 0);
#endif
#if MASKED
    bool masked = (materials[material].flags & MATERIAL_ALPHA_MASK) != 0u;
    float cutoff = masked ? materials[material].alphaCutoff : blendThreshold();
    if (base.a < cutoff) discard;
#endif

    vec3 n = normalize(interpolatedNormal);
    float spread = 0.0;
#if TEXTURES >= 2
    vec4 metalRough = materialTexel(metalRoughTexture, material, 1);
    roughness *= metalRough.g;
    float metallic = materials[material].metallic * metalRough.b;
    vec3 f0 = materials[material].specularF0 * materialTexel(specularTexture, material, 4).a *
              materialTexel(specularColorTexture, material, 5).rgb;
    reflectance = packReflectance(f0, metallic);
    emissionFactor = materialTexel(emissiveTexture, material, 3).rgb;

    // Normal map: x along the tangent, y along the bitangent. Without a map the texel is white: leave n
    // alone.
    TexelFootprint footprint;
    vec3 texel = materialTexel(normalTexture, material, 2, footprint).xyz * 2.0 - 1.0;
    vec3 t = interpolatedTangent.xyz - n * dot(n, interpolatedTangent.xyz);
    float tLength = length(t);
    if (materials[material].layers.z >= 0 && tLength > 1e-6) {
        t /= tLength;
        vec3 b = cross(n, t) * (interpolatedTangent.w < 0.0 ? -1.0 : 1.0);
        float scale = materials[material].normalScale;
        n = normalize(t * (texel.x * scale) + b * (texel.y * scale) + n * max(texel.z, 1e-3));
        bool unit = (materials[material].flags & MATERIAL_UNIT_NORMALS) != 0u;
        spread = unit ? normalSpread(texel, scale, footprint) : 0.0;
        if (spread > 0.0) roughness = spreadRoughness(roughness, spread);
    }
#endif

    // Both normals face the eye. The vertex normal decides which side n is on, not the winding: files whose
    // triangles wind the wrong way round are common, and look right by their normals.
    vec3 face = faceNormal();
    if (dot(interpolatedNormal, face) < 0.0) n = -n;

    // The back of a single-sided emitter is dark.
    bool back = !gl_FrontFacing;
    if (back && (materials[material].flags & MATERIAL_DOUBLE_SIDED) == 0u) emissionFactor = vec3(0.0);

    outGeometry = uvec4(floatBitsToUint(viewDepth()), packSnorm2x16(octEncode(n)),
                        packSnorm2x16(octEncode(face)), constant.x | packSpread(spread) | (back ? 1u : 0u));
    outMaterial = uvec4(packUnorm2x16(base.rg), packUnorm2x16(vec2(base.b, roughness)), reflectance,
                        packEmissionFactor(emissionFactor));
    if ((constant.x & 2u) != 0u) outMaterial.xy = packUnlit(base.rgb);
}
