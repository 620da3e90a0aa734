// SPDX-License-Identifier: MIT
// A surface's own axes, and the GGX distribution in them.
#pragma once

#include <glm/glm.hpp>

namespace conelight::reference {

// Two unit vectors that span the plane normal to a unit vector (Duff et al. 2017, "Building an Orthonormal
// Basis, Revisited").
struct Frame {
    explicit Frame(const glm::vec3& normal);
    glm::vec3 toLocal(const glm::vec3& v) const { return {glm::dot(v, u), glm::dot(v, w), glm::dot(v, n)}; }
    glm::vec3 toWorld(const glm::vec3& v) const { return u * v.x + w * v.y + n * v.z; }
    glm::vec3 u, w, n;
};

constexpr float kMinNoV = 1e-4f;  // as math::makeBrdf clamps it

// A local direction to the eye, or the nearest one that is not below the horizon.
glm::vec3 aboveHorizon(const glm::vec3& toEye);
// D of GGX at a local half vector.
float ggx(float alpha2, const glm::vec3& h);
// D G2 / (4 NoV) for local directions: the lobe times the cosine to the light, without Fresnel's factor.
float ggxTimesCosine(float alpha, const glm::vec3& h, float NoL, float NoV);
// Density of reflected directions when visible normals are sampled: G1 D / (4 NoV).
float visibleDensity(float alpha2, float distribution, float NoV);
// A normal that the eye sees; u in [0,1).
glm::vec3 sampleVisibleNormal(const glm::vec3& toEye, float alpha, const glm::vec2& u);

}  // namespace conelight::reference
