#version 450 core
// SPDX-License-Identifier: MIT
// Fragments of instances that have a coat or sheen -> the words of lib/layers.glsl, where the G-buffer shows them. Vertices
// are those of view/gbuffer.vert.glsl, with TEXTURES 2.
#include "lib/dot.glsl"
#include "lib/frame_block.glsl"
#include "lib/layers.glsl"
#include "lib/scene_tables.glsl"
#include "lib/texture_filter.glsl"

layout(location = 0) in vec3 fromEye;
layout(location = 1) in vec3 interpolatedNormal;
layout(location = 2) in vec4 interpolatedBase;
layout(location = 3) flat in uvec4 constant;
layout(location = 4) in vec2 uv;
layout(location = 5) in vec4 interpolatedTangent;
uniform usampler2D gbufferGeometry;
uniform sampler2D coatTexture;
uniform sampler2D coatRoughnessTexture;
uniform sampler2D coatNormalTexture;
uniform sampler2D sheenColorTexture;
uniform sampler2D sheenRoughnessTexture;

layout(location = 0) out uvec4 outLayers;

// Two rasterizations of a triangle snap its corners alike, but for rounding: then it lies less than this beside itself.
const float kSameDepth = 1e-3;

// Texel of the use-th texture (order of Material::layerUvRow), as materialTexel of view/gbuffer.frag.glsl.
vec4 layerTexel(sampler2D map, uint material, int use) {
    vec3 row0 = materials[material].layerUvRow[2 * use].xyz;
    vec3 row1 = materials[material].layerUvRow[2 * use + 1].xyz;
    mat2 turn = mat2(row0.x, row1.x, row0.y, row1.y);
    vec2 at = turn * uv + vec2(row0.z, row1.z);
    return filteredTexel(
        map, at,
        texelFootprint(map, frame.footprint * (turn * dFdx(uv)), frame.footprint * (turn * dFdy(uv))));
}

// Not bent by the base's map; by that of the coat, if it has one.
vec3 coatNormal(uint material) {
    vec3 n = normalize(interpolatedNormal);
    vec3 texel = layerTexel(coatNormalTexture, material, 2).xyz * 2.0 - 1.0;
    vec3 t = interpolatedTangent.xyz - n * dot(n, interpolatedTangent.xyz);
    float tLength = length(t);
    if (materials[material].coatNormalMap < 0 || tLength <= 1e-6) return n;
    t /= tLength;
    vec3 b = cross(n, t) * (interpolatedTangent.w < 0.0 ? -1.0 : 1.0);
    float scale = materials[material].coatNormalScale;
    return normalize(t * (texel.x * scale) + b * (texel.y * scale) + n * max(texel.z, 1e-3));
}

void main() {
    uint material = constant.z;
    vec3 n = coatNormal(material);
    Layers l = Layers(n, materials[material].coat * layerTexel(coatTexture, material, 0).r,
                      materials[material].coatRoughness * layerTexel(coatRoughnessTexture, material, 1).g,
                      materials[material].sheenColor * layerTexel(sheenColorTexture, material, 3).rgb,
                      materials[material].sheenRoughness * layerTexel(sheenRoughnessTexture, material, 4).a);

    uvec4 geometry = texelFetch(gbufferGeometry, ivec2(gl_FragCoord.xy), 0);
    float depth = frame.parallel != 0.0 ? dot(fromEye, frame.viewForward) : 1.0 / gl_FragCoord.w;
    float shown = uintBitsToFloat(geometry.x);
    bool same = instanceOfWord(geometry.w) == instanceOfWord(constant.x) &&
                abs(depth - shown) <= kSameDepth * abs(shown);
    if (!same) discard;
    // On the side that the vertex normal says, as the base's.
    vec3 face = octDecode(unpackSnorm2x16(geometry.z));
    if (dot(interpolatedNormal, face) < 0.0) l.coatNormal = -l.coatNormal;
    outLayers = packLayers(l);
}
