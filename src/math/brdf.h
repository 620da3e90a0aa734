// SPDX-License-Identifier: MIT
// C++ twin of shaders/lib/brdf.glsl, function by function; its comments hold the method and the citations.
#pragma once

#include <glm/glm.hpp>

namespace conelight::math {

constexpr float kMinRoughness = 0.045f;
constexpr float kCoatF0 = 0.04f;  // of a clear coat, index 1.5

struct Brdf {
    glm::vec3 diffuse;  // directional albedo of the diffuse part: radiance = diffuse / pi * irradiance
    glm::vec3 f0;
    glm::vec3 f90;
    glm::vec3 compensation;  // factor on the specular lobe
    glm::vec3 albedo;        // directional albedo of the specular lobe, compensation included
    float alpha;             // GGX width
    float NoV;
};

// Directional albedo of the single-scattering lobe: F0 x + F90 y. `roughness` is perceptual.
glm::vec2 directionalAlbedo(float NoV, float roughness);

glm::vec3 fresnel(const glm::vec3& f0, const glm::vec3& f90, float VoH);
Brdf makeBrdf(const glm::vec3& baseColor, float metallic, float roughness, const glm::vec3& dielectricF0,
              float NoV);

// Reflectance of dielectrics as rays are told of it.
constexpr float kDielectricF0 = 0.04f;

// A surface as rays are told of it: a dielectric that reflects more than kDielectricF0 counts as partly metal. Shader twin:
// metallicSurface in shaders/lib/brdf.glsl.
struct MetallicSurface {
    glm::vec3 baseColor;
    float metallic;
    glm::vec3 dielectricF0;
};
MetallicSurface metallicSurface(const glm::vec3& baseColor, float metallic, const glm::vec3& dielectricF0);

// Reflectance in even light, both lobes; what voxels keep as a surface's colour.
glm::vec3 evenAlbedo(const glm::vec3& baseColor, float metallic, float roughness,
                     const glm::vec3& dielectricF0);

// What a coat takes of even light, by evenAlbedo's measure.
float evenCoat(float roughness);

// GGX times visibility, D G2 / (4 NoL NoV).
float ggxVisible(float alpha, float NoH, float NoL, float NoV);

// The specular BRDF (1/sr) for unit vectors to the light and to the eye.
glm::vec3 brdfSpecular(const Brdf& brdf, const glm::vec3& n, const glm::vec3& toLight,
                       const glm::vec3& toEye);

}  // namespace conelight::math
