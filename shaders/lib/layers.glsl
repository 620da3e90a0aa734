// SPDX-License-Identifier: MIT
// Coat and sheen of what pixels show: four words per pixel (view/layers.frag.glsl), all 0 where there are none.
//
//   x  the coat's normal, octahedral, 2 x 16 bit signed; faces the eye
//   y  share that is coated, the coat's perceptual roughness, 16 bit each
//   z  the sheen's colour, 10 bit square roots
//   w  the sheen's perceptual roughness, 16 bit
#include "lib/gbuffer_pack.glsl"
#include "lib/octahedral.glsl"

struct Layers {
    vec3 coatNormal;
    float coat;
    float coatRoughness;
    vec3 sheenColor;
    float sheenRoughness;
};

uvec4 packLayers(Layers l) {
    return uvec4(packSnorm2x16(octEncode(l.coatNormal)), packUnorm2x16(vec2(l.coat, l.coatRoughness)),
                 packEmissionFactor(l.sheenColor), packUnorm2x16(vec2(l.sheenRoughness, 0.0)));
}

Layers unpackLayers(uvec4 bits) {
    vec2 coat = unpackUnorm2x16(bits.y);
    return Layers(octDecode(unpackSnorm2x16(bits.x)), coat.x, coat.y, unpackEmissionFactor(bits.z),
                  unpackUnorm2x16(bits.w).x);
}

bool hasLayers(uvec4 bits) { return (bits.y & 0xffffu) != 0u || bits.z != 0u; }

const float kCoatF0 = 0.04;  // index 1.5; C++ twin: math::kCoatF0
