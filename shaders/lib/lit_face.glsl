// SPDX-License-Identifier: MIT
// Faces as light left them (LitFace of shared/irradiance.h), a texel each.
#include "lib/voxel_record.glsl"
#include "shared/irradiance.h"
uniform usamplerBuffer litFaces;

vec3 litIrradiance(uvec4 lit) { return vec3(unpackHalf2x16(lit.z), unpackHalf2x16(lit.w).x); }

// Metalness and roughness, by the last word of a lit face.
vec2 litLobe(uint bits) { return unpackLobe(bits >> FACE_LOBE_SHIFT); }

// Whether that is a dielectric whose lobe is told from even light.
bool isGlossyDielectric(vec2 lobe) { return lobe.x == 0.0 && lobe.y > 0.0 && lobe.y <= LOBE_MAX_ROUGHNESS; }

// Outgoing radiance of a diffuse face: emission, reflected direct light, reflected irradiance.
vec3 litRadiance(uvec4 lit) { return unpackRgb9e5(lit.y) + unpackAlbedo(lit.x) * litIrradiance(lit); }

// Updates behind the irradiance, rounded down to a power of two.
uint faceUpdates(uint irradiance1) {
    uint age = (irradiance1 >> FACE_AGE_SHIFT) & FACE_AGE_MASK;
    return (irradiance1 & FACE_INTERIOR) != 0u ? FACE_UPDATES_INTERIOR : (age == 0u ? 0u : 1u << (age - 1u));
}
