// SPDX-License-Identifier: MIT
// Light that arrives at a point: straight from lights (shadow rays; area lights by their exact form factor
// times the visible part), and from everything else along cosine-distributed rays, of which each stands for
// the same form factor (Malley 1988, "A Shading Method for Computer Generated Images").
#pragma once

#include <memory>
#include <vector>

#include "conelight/scene.h"
#include "reference/lights.h"
#include "reference/radiosity_mesh.h"
#include "reference/ray_scene.h"

namespace conelight::reference {

// A point that receives light, on its side of the surface.
struct Receiver {
    glm::vec3 position{0};
    glm::vec3 geometricNormal{0};
    glm::vec3 shadingNormal{0};
    bool castsShadow = true;
};

class RadiosityLights {
  public:
    // `emissiveQuads`: flat emitters are direct light.
    explicit RadiosityLights(const Scene& scene, bool emissiveQuads = true);

    // Which light: direct, or from emitters that are not direct light (path_tracer.h).
    struct Kinds {
        bool direct = true;
        bool indirect = true;
    };
    // Irradiance from lights without extent and from area lights. `rays` are counted up.
    glm::vec3 irradiance(const RayScene& rays, const Receiver& at, int lightRays, const Kinds& kinds,
                         std::uint64_t& count) const;
    // Emission of this instance is counted above, and must not be met by rays again.
    bool isAreaLight(std::uint32_t instance) const { return areaLight_[instance]; }

  private:
    struct Single {
        Scene scene;  // holds one light
        std::unique_ptr<LightTable> table;
    };
    struct AreaLight {
        glm::dvec3 corner{0}, edgeU{0}, edgeV{0};
        bool triangle = false, round = false, direct = true, castsShadow = true, twoSided = false;
        glm::dvec3 normal{0};  // shining side
        glm::vec3 radiance{0};
        double sphere = 0;  // radius about `corner`, if it is one
    };
    struct Outline;
    static Outline outlineOf(const AreaLight& light);
    static AreaLight discOf(const AreaLight& sphere, const glm::dvec3& seenFrom);
    void addRect(const Light& light);
    void addTriangles(const Scene& scene, std::uint32_t instance);
    double visiblePart(const RayScene& rays, const Receiver& at, const AreaLight& light, int edge,
                       std::uint64_t& count, bool& mixed) const;
    std::vector<std::unique_ptr<Single>> singles_;
    std::vector<AreaLight> areas_;
    std::vector<bool> areaLight_;
};

// The n-th of `count` cosine-distributed directions around a normal: Hammersley's points (1960), turned by
// `shift` (Cranley and Patterson 1976).
glm::vec3 cosineDirection(const glm::vec3& normal, std::uint32_t n, std::uint32_t count,
                          const glm::vec2& shift);

}  // namespace conelight::reference
