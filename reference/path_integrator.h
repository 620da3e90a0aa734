// SPDX-License-Identifier: MIT
// One path: a camera ray -> the radiance that comes back along it, split into the parts of PathTracedPicture.
// Method: path_integrator.cpp.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "reference/lights.h"
#include "reference/materials.h"
#include "reference/path_tracer.h"
#include "reference/ray_scene.h"
#include "reference/sampler.h"
#include "scene/surroundings.h"

namespace conelight::reference {

struct PathSample {
    glm::vec3 direct{0}, diffuse{0}, specular{0};
    std::vector<glm::vec3> bounces;  // sized by the caller; bounces beyond its size are not kept
    bool seen = false;               // the camera ray met a surface
    glm::vec3 albedo{0}, gloss{0}, emission{0}, normal{0};  // as in FeaturePictures
    float distance = 0;
    std::uint64_t rays = 0;  // added to

    void clear();
    bool finite() const;
};

class PathIntegrator {
  public:
    PathIntegrator(const Scene& scene, const RayScene& rays, const PathTracerSettings& settings);

    // `pixel`: what the pixel's width and height add to the camera ray's direction. The first surface shows
    // its textures' mean over it, a point of it per sample. Null: textures at the hit alone. Thread-safe.
    struct PixelTurns {
        std::array<glm::vec3, 2> steps;
        bool parallel;  // steps are moves aside, m, instead of turns of the direction
    };
    void trace(const Ray& cameraRay, const PixelTurns* pixel, Sampler& sampler, PathSample& result) const;
    // What a surface of `instance` sends along its shading normal, less its emission, in `direct`, `diffuse` and
    // `specular`. Of white diffuse surfaces this is what arrives, divided by pi. Thread-safe.
    void reflectedAt(const Surface& surface, std::uint32_t instance, Sampler& sampler,
                     PathSample& result) const;

  private:
    // The end of a path so far.
    struct Vertex {
        Surface surface;
        glm::vec3 toEye{0};  // unit; back along the path
        std::uint32_t instance = 0;
        int depth = 0;                     // surfaces before this one
        glm::vec3 throughput{1};           // of what happens here towards the camera
        LightTable::Choice lights;         // how they are sampled from here
        glm::vec3 diffuseShare{0};         // of the first surface's reflection, from depth 1 on
        const Material* medium = nullptr;  // the solid that the path is in
        bool alone = false;                // the next direction is one that no ray to a light could have been
        bool mirrored = false;             // the next direction is that of an ideal mirror
        bool unmarked = true;              // nothing that has features was met yet
        float distance = 0;                // along the path from the eye, m
    };
    // Where a ray ends that goes on through smooth panes.
    struct Arrival {
        RayHit hit;
        Surface surface;
        glm::vec3 passed{1};  // what the panes left, over how often they are passed
    };
    bool wanted(int bounce) const { return settings_.bounces < 0 || bounce <= settings_.bounces; }
    // Of light that bounces as often, which a path finds that ends like this.
    bool wanted(const Vertex& end, int bounce) const {
        const bool reached = settings_.paths == Paths::All || bounce <= end.depth + (end.mirrored ? 1 : 0);
        return reached && wanted(bounce);
    }
    static void add(PathSample& result, const Vertex& vertex, int bounce, const glm::vec3& light,
                    const Reflection::Value& value);
    static void mark(Vertex& vertex, const Reflection& reflection, PathSample& result);
    bool find(RayKind kind, Ray ray, const PixelTurns* pixel, Sampler& sampler, Arrival& arrival) const;
    glm::vec3 arriving(const Vertex& vertex, const LightSample& light, bool through,
                       PathSample& result) const;
    void gatherLights(const Vertex& vertex, const Reflection& reflection, Sampler& sampler,
                      PathSample& result) const;
    void gatherGroup(const Vertex& vertex, const Reflection& reflection, std::size_t group, float within,
                     const glm::vec2& u, PathSample& result) const;
    void gatherSky(const Vertex& vertex, const Reflection& reflection, const glm::vec2& u,
                   PathSample& result) const;
    void gather(Vertex& vertex, const Reflection& reflection, Sampler& sampler, PathSample& result) const;
    void follow(Vertex& vertex, Sampler& sampler, PathSample& result) const;
    float skyWeight(const Vertex& vertex, const glm::vec3& direction, const Reflection::Value& value) const;
    bool advance(Vertex& vertex, const Reflection& reflection, const std::array<glm::vec2, 2>& numbers,
                 Sampler& sampler, PathSample& result) const;
    bool arriveAt(Vertex& vertex, const Ray& ray, const Reflection::Value& value, Sampler& sampler,
                  PathSample& result) const;

    const Scene& scene_;
    const RayScene& rays_;
    PathTracerSettings settings_;
    LightTable lights_;
    scene::Surroundings surroundings_;
};

}  // namespace conelight::reference
