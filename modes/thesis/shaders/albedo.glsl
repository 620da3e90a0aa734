// SPDX-License-Identifier: MIT
// Shares of light that a material of the thesis reflects.
#include "thesis/shaders/defects.glsl"

// As by a mirror. The Phong model's strength is the height of its lobe, not a share; scenes give broad lobes
// strengths of 1 and more. The rule is that of setPbrFromPhong (src/scene/scene.cpp), so that all modes see the
// same material.
float reflectance(float phongSpecular, float shininess) {
#if UNBOUNDED_SPECULAR
    return phongSpecular;
#else
    return min(phongSpecular, 1.0) * shininess / (shininess + 62.0);
#endif
}

// Diffusely; `mirrored`: the share above.
vec3 diffuseAlbedo(vec3 color, float phongDiffuse, float mirrored) {
    vec3 albedo = color * phongDiffuse;
#if !UNBOUNDED_SPECULAR
    albedo = min(albedo, 1.0) * (1.0 - mirrored);
#endif
    return albedo;
}
