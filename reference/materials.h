// SPDX-License-Identifier: MIT
// Reflection at a surface as the path tracer needs it: value, sampling and density of the BRDF of
// src/math/brdf.h (Lambert + GGX), for one direction to the eye.
//
// Sampling: cosine-weighted for the diffuse part, visible normals for the lobe (Heitz 2018, "Sampling the GGX
// Distribution of Visible Normals"; by spherical caps, Dupuy and Benyoub 2023), chosen by their albedos; the
// density is that of the mixture. Shading normals that face away from the eye, as interpolation makes them at
// silhouettes, are sampled as if seen at grazing angle, where the value is clamped as well (kMinNoV).
#pragma once

#include "math/brdf.h"
#include "reference/surface.h"

namespace conelight::reference {

// Two unit vectors that span the plane normal to a unit vector (Duff et al. 2017, "Building an Orthonormal
// Basis, Revisited").
struct Frame {
    explicit Frame(const glm::vec3& normal);
    glm::vec3 toLocal(const glm::vec3& v) const { return {glm::dot(v, u), glm::dot(v, w), glm::dot(v, n)}; }
    glm::vec3 toWorld(const glm::vec3& v) const { return u * v.x + w * v.y + n * v.z; }
    glm::vec3 u, w, n;
};

class Reflection {
  public:
    struct Value {
        glm::vec3 diffuse{0}, specular{0};  // BRDF times cosine, 1/sr
        float density = 0;                  // of sample(), 1/sr
        glm::vec3 sum() const { return diffuse + specular; }
    };

    Reflection(const Surface& surface, const glm::vec3& toEye);

    // Zero below the horizon of the shading normal.
    Value evaluate(const glm::vec3& toLight) const;
    // A direction (unit); `lobe` and `u` in [0,1).
    glm::vec3 sample(float lobe, const glm::vec2& u) const;
    bool black() const { return black_; }

  private:
    Frame frame_;
    math::Brdf brdf_;
    glm::vec3 toEye_;       // local
    glm::vec3 toEyeAbove_;  // local, above the horizon
    float specularShare_ = 0;
    bool black_ = false;
};

// Uniform over the hemisphere around a unit vector; density 1 / (2 pi).
glm::vec3 uniformHemisphere(const glm::vec3& normal, const glm::vec2& u);

}  // namespace conelight::reference
