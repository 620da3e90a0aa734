// SPDX-License-Identifier: MIT
// What light arrives at a point along a ray, as bakers want it: the path tracer's, less what lights and flat
// emissive quads send straight.
#pragma once

#include <vector>

#include "reference/path_integrator.h"
#include "reference/ray_scene.h"
#include "reference/sampler.h"
#include "scene/surroundings.h"

namespace conelight::reference {

struct Arriving {
    glm::vec3 radiance{0};  // W/(sr m^2)
    float distance = 0;     // infinite: nothing met
    bool back = false;      // of a single-sided surface, which sends nothing
};

class ArrivingLight {
  public:
    struct Settings {
        int samples = 1024;  // rays of a point
        int bounces = -1;    // of indirect light, 1 or more; -1: all
        std::uint32_t seed = 1;
    };
    // `scene` must outlive it.
    ArrivingLight(const Scene& scene, const Settings& settings);

    // Where a ray ends, without its light. Thread-safe.
    Arriving meet(const glm::vec3& origin, const glm::vec3& direction, RayHit& hit) const;
    // With the light of one path. `path` is room to work in. Thread-safe.
    Arriving arriving(const glm::vec3& origin, const glm::vec3& direction, Sampler& sampler,
                      PathSample& path) const;
    const RayScene& rays() const { return rays_; }
    const scene::Surroundings& surroundings() const { return surroundings_; }
    // Whether light of the surroundings arrives along a ray: no voxelized instance is in its way. Thread-safe.
    bool isOpen(const glm::vec3& origin, const glm::vec3& direction) const {
        return !rays_.occluded(RayKind::Bounce, Ray{.origin = origin, .direction = direction});
    }

  private:
    const Scene& scene_;
    RayScene rays_;
    PathTracerSettings settings_;
    PathIntegrator integrator_;
    scene::Surroundings surroundings_;
    std::vector<bool> isQuad_;
};

}  // namespace conelight::reference
