// SPDX-License-Identifier: MIT
// What a ray hit: textures, vertex colours and normals evaluated at a point, by the same rules as the GL
// modes' G-buffer (bilinear, level 0). What a pixel sees of a texture is the mean of many such points over
// its footprint, which the path tracer chooses.
#pragma once

#include "conelight/scene.h"
#include "reference/ray_scene.h"

namespace conelight::reference {

// What an instance is made of; one that names no material has the default one.
const Material& materialOf(const Scene& scene, const Instance& instance);

struct Surface {
    glm::vec3 position{0};
    glm::vec3 geometricNormal{0};  // on the side the ray came from
    glm::vec3 shadingNormal{0};    // interpolated, normal-mapped, on that side
    bool frontFace = true;
    const Material* material = nullptr;
    glm::vec3 baseColor{0};
    float metallic = 0, roughness = 1;
    glm::vec3 dielectricF0{0.04f};
    glm::vec3 emission{0};   // radiance toward the ray: 0 on the back of single-sided materials
    bool unlit = false;      // emission is its colour; reflects nothing
    float opacity = 1;       // of a blended surface: how often it is met
    float transmission = 0;  // share of the light below the gloss that goes through
    bool solid = false;      // of what goes through: it is bent, and this is one side of a closed surface
    // Layers above: a clear coat about a normal of its own, and sheen.
    float coat = 0, coatRoughness = 0;
    glm::vec3 coatNormal{0};
    glm::vec3 sheenColor{0};
    float sheenRoughness = 0;
    bool layered() const { return coat > 0 || sheenColor != glm::vec3(0); }
};

// `turn`: textures are read where the ray would meet the plane of the triangle if this were added to its
// direction, to first order (ray differentials, Igehy 1999); everything else stays that of the hit.
Surface surfaceAt(const Scene& scene, const Ray& ray, const RayHit& hit,
                  const glm::vec3& turn = glm::vec3(0));
// For normals, which have to be normalized: the inverse transpose times the determinant's size, which exists for flat
// scales too.
glm::mat3 normalTransform(const glm::mat3& worldFromObject);
// The point itself: its place, and the interpolated normal, unit, on the side of the vertices' normals.
struct SurfacePoint {
    glm::vec3 position{0}, normal{0};
};
SurfacePoint pointAt(const Scene& scene, const RayHit& hit);
// Whether what a hit, or anything in the scene, shows depends on textures.
bool isTextured(const Scene& scene, const RayHit& hit);
bool isTextured(const Scene& scene);
// Whether there is a surface at a hit: masked materials below their cut-off, and blended ones below one half,
// have none, as in voxels and shadow maps.
bool coversAt(const Scene& scene, std::uint32_t instance, std::uint32_t triangle,
              const glm::vec2& barycentric);
// Radiance that a point of a triangle gives off (from the sides that shine): 0 where a mask leaves nothing, by
// its opacity where it is blended, and 0 for unlit materials, which light nothing.
glm::vec3 emissionAt(const Scene& scene, std::uint32_t instance, std::uint32_t triangle,
                     const glm::vec2& barycentric);
// Linear RGBA of a texture at uv, bilinear or nearest, wrapped as it says; sRGB is decoded before filtering.
glm::vec4 sampleTexture(const Scene& scene, const TextureRef& reference, const glm::vec2& uv);

}  // namespace conelight::reference
