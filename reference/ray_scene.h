// SPDX-License-Identifier: MIT
// Rays against the scene's triangles (Embree 3 or 4). Triangles stand in world space, one geometry per
// instance. What a ray can hit depends on who asks; masked surfaces (AlphaMode::Mask below the cutoff) are
// not there for anybody.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>

#include "conelight/scene.h"

namespace conelight::reference {

// Rays to a place end this part of the way before it, so that they do not meet it.
inline constexpr float kRayEnd = 1 - 1e-5f;

// camera: visible instances, single-sided ones from their front only. bounce: voxelized ones. shadow: those
// with castsShadow.
enum class RayKind { Camera, Bounce, Shadow };

// Blended surfaces (AlphaMode::Blend): there where they hide one half and more, as in voxels and shadow maps; or
// met wherever they are, whatever they hide.
enum class Blended { Cut, Met };

struct Ray {
    glm::vec3 origin{0};
    glm::vec3 direction{0, 0, 1};  // unit
    float tMin = 0;
    float tMax = 3.4e38f;
};

struct RayHit {
    float t = 0;
    std::uint32_t instance = 0;
    std::uint32_t triangle = 0;
    glm::vec2 barycentric{0};      // weights of vertices 1 and 2
    glm::vec3 geometricNormal{0};  // unit, counter-clockwise side (mirrored instances: glTF's front)
};

class RayScene {
  public:
    // `scene` must outlive it. Throws Error(Runtime) when memory runs out.
    explicit RayScene(const Scene& scene);
    ~RayScene();
    RayScene(RayScene&&) noexcept;
    RayScene& operator=(RayScene&&) noexcept;

    // Thread-safe.
    bool intersect(RayKind kind, const Ray& ray, RayHit& hit, Blended blended = Blended::Cut) const;
    bool occluded(RayKind kind, const Ray& ray) const;  // thread-safe
    // What is left of light along a ray that goes straight on through blended surfaces and smooth panes; with `unbent` through all
    // that is transmissive. Thread-safe.
    glm::vec3 transmittance(RayKind kind, const Ray& ray, bool unbent) const;

    // Start of a ray that leaves a surface point on the side of `normal`, clear of the surface whatever its
    // distance from the origin (Waechter and Binder 2019).
    static glm::vec3 offsetOrigin(const glm::vec3& point, const glm::vec3& geometricNormal);

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace conelight::reference
