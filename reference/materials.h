// SPDX-License-Identifier: MIT
// Scattering at a surface as the path tracer needs it: value, sampling and density of the BRDF of
// src/math/brdf.h (Lambert + GGX), for one direction to the eye.
//
// Glass: light below the gloss goes through instead of being scattered back. A rough pane scatters it into the
// mirror image of its reflection lobe (KHR_materials_transmission). A solid bends it at its facets (Walter et
// al. 2007, "Microfacet Models for Refraction through Rough Surfaces"); within it nothing leaves beyond the
// critical angle. Radiance is that of air: its growth by the square of the index within a solid, which its
// other side undoes, is left out. Smooth panes turn no ray: what they let through is straightPass, the
// tracing's business.
//
// Mirrors: opaque surfaces below math::kMinRoughness, the limit of the GL modes, reflect as an ideal mirror
// does: one direction, by Schlick's Fresnel, which no ray to a light could have been. What the mirror leaves of
// light is diffuse.
//
// Layers: coat and sheen lie on opaque surfaces. They are lobes beside those of the base, which is seen by what they let
// through (reference/layers.h).
//
// Sampling: cosine-weighted for the diffuse part, visible normals for the lobe (Heitz 2018, "Sampling the GGX
// Distribution of Visible Normals"; by spherical caps, Dupuy and Benyoub 2023), chosen by their albedos; the
// density is that of the mixture. Shading normals that face away from the eye, as interpolation makes them at
// silhouettes, are sampled as if seen at grazing angle, where the value is clamped as well (kMinNoV).
#pragma once

#include <optional>

#include "math/brdf.h"
#include "reference/frame.h"
#include "reference/layers.h"
#include "reference/surface.h"

namespace conelight::reference {

class Reflection {
  public:
    struct Value {
        glm::vec3 diffuse{0}, specular{0};  // BRDF times cosine, 1/sr
        float density = 0;                  // of sample(), 1/sr
        glm::vec3 sum() const { return diffuse + specular; }
    };

    Reflection(const Surface& surface, const glm::vec3& toEye);

    // Zero below the horizon of the shading normal, but for rough panes.
    Value evaluate(const glm::vec3& toLight) const;
    // A direction; `lobe` and `u` in [0,1).
    struct Draw {
        glm::vec3 direction{0};  // unit; 0: none
        bool below = false;      // through the surface
        bool alone = false;      // at a mirror or the facets of a solid: evaluate() knows nothing of it, and
        Value value;             // `value`, of density 1, is the weight
        bool mirrored = false;   // at a mirror
    };
    Draw draw(float lobe, const glm::vec2& u) const;
    // Of what stays above the surface alone.
    glm::vec3 sample(float lobe, const glm::vec2& u) const;
    bool black() const { return black_ && !layers_; }
    // Of light that rays to lights find: none at the inner side of a solid.
    bool inside() const { return inside_; }
    bool scattersThrough() const { return transmissionShare_ > 0 && !solid_; }
    // Of ideal mirrors, a smooth coat among them: the share of light that is mirrored towards the eye; 0 of all else.
    glm::vec3 mirrorShare() const;

  private:
    void addLayers(const Surface& surface, const glm::vec3& toEye);
    Value evaluateBase(const glm::vec3& toLight) const;
    Draw drawBase(float lobe, const glm::vec2& u) const;
    Draw drawThrough(const glm::vec2& u) const;
    Draw drawInside(float lobe, const glm::vec2& u) const;
    struct Facet {
        glm::vec3 mirrored{0}, refracted{0};  // local directions; refracted: 0 where nothing goes through
        glm::vec3 reflected{1};               // share of light
    };
    Facet facet(const glm::vec2& u) const;
    float maskedShare(float NoL) const;

    Frame frame_;
    math::Brdf brdf_;
    glm::vec3 toEye_;       // local
    glm::vec3 toEyeAbove_;  // local, above the horizon
    float specularShare_ = 0;
    bool black_ = false;
    glm::vec3 tint_{0};     // of light at each side of a solid
    glm::vec3 through_{0};  // directional albedo of what goes through
    float transmissionShare_ = 0;
    glm::vec2 facets_{1, 0};  // math::directionalAlbedo
    float eta_ = 1;           // index of the other side over that of the eye's
    bool solid_ = false, inside_ = false;
    bool mirror_ = false;
    std::optional<Layers> layers_;
    float coatShare_ = 0, sheenShare_ = 0, baseShare_ = 1;  // of draws
};

// Whether a surface is an ideal mirror, on top of what it reflects diffusely.
bool isMirror(const Surface& surface);

// Whether a ray that meets the surface may go on as if it were not there; which part of its light then, and how
// often it should.
bool passesStraight(const Surface& surface);
struct StraightPass {
    glm::vec3 transmittance;
    float share;
};
StraightPass straightPass(const Surface& surface, const glm::vec3& toEye);
// Of light in a solid, 1/m (Beer and Lambert).
glm::vec3 absorption(const Material& material);

// Uniform over the hemisphere around a unit vector; density 1 / (2 pi).
glm::vec3 uniformHemisphere(const glm::vec3& normal, const glm::vec2& u);

float largest(const glm::vec3& color);
float luminance(const glm::vec3& color);  // of linear BT.709

}  // namespace conelight::reference
