// SPDX-License-Identifier: MIT
// What lies on a surface's base: sheen, and a clear coat above it (KHR_materials_sheen, _clearcoat). Each scatters by a
// lobe of its own, and lets through what the lobe does not send to the eye (docs/theory/3_light.md, "Coat and sheen").
#pragma once

#include "math/brdf.h"
#include "math/sheen.h"
#include "reference/frame.h"
#include "reference/surface.h"

namespace conelight::reference {

class Layers {
  public:
    Layers(const Surface& surface, const glm::vec3& toEye);

    // Share of the base's light that reaches the eye, and directional albedos of the lobes, as they are seen.
    float below() const { return below_; }
    float coatAlbedo() const { return coat_ * coatBrdf_.albedo.r; }
    const glm::vec3& sheenAlbedo() const { return sheenAlbedo_; }

    // BRDF times cosine, 1/sr, and the density of drawing.
    struct Lobe {
        glm::vec3 value{0};
        float density = 0;
    };
    // Nothing of a coat that mirrors (coatMirrors): it is met in one direction alone.
    Lobe coatLobe(const glm::vec3& toLight) const;
    Lobe sheenLobe(const glm::vec3& toLight) const;
    // By visible normals, or mirrored; evenly over the hemisphere.
    glm::vec3 drawCoat(const glm::vec2& u) const;
    glm::vec3 drawSheen(const glm::vec2& u) const;
    bool coatMirrors() const { return coatMirrors_; }

  private:
    Frame base_, coatFrame_;
    glm::vec3 toEye_, toEyeAbove_;          // of the base, local
    glm::vec3 coatToEye_, coatToEyeAbove_;  // of the coat, local
    math::Brdf coatBrdf_;
    float coat_;
    bool coatMirrors_;
    float sheenRoughness_;
    glm::vec3 sheen_{0};  // factor on the sheen's term
    glm::vec3 sheenAlbedo_{0};
    float below_ = 1;
};

// Share of a surface's own light that reaches the eye through its layers.
float shareBelowLayers(const Surface& surface, const glm::vec3& toEye);
// Reflectance in even light of what has this one without its layers.
glm::vec3 evenAlbedoOfLayers(const Surface& surface, const glm::vec3& base);

}  // namespace conelight::reference
