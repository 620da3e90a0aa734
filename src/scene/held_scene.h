// SPDX-License-Identifier: MIT
// The scene that a Renderer or a LightField holds: its calls as the public headers promise them, each checked,
// and under a guard of the host's GL state.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "scene/gpu_scene.h"

namespace conelight::scene {

class HeldScene {
  public:
    // `scene` is valid. The old one is freed first.
    void set(const Scene& scene);
    explicit operator bool() const { return scene_.has_value(); }
    // Throws Error(Usage) without a scene, in the name of a call.
    GpuScene& require(const char* call);
    const GpuScene& operator*() const { return *scene_; }
    const GpuScene* operator->() const { return &*scene_; }

    // Throw Error(Usage) without a scene and for indices out of range, Error(BadInput) for what
    // Scene::validate refuses; nothing is changed then.
    void setInstance(std::size_t index, const Instance& instance);
    void setMesh(std::size_t index, const Mesh& mesh);
    void setMesh(const gl::Device& device, std::size_t index, const HostMesh& mesh);
    void setTexture(std::size_t index, const Texture& texture);
    void setTexture(const gl::Device& device, std::size_t index, const HostTexture& texture);
    void setMaterial(std::size_t index, const Material& material);
    void setLight(std::size_t index, const Light& light);
    void setLights(const std::vector<Light>& lights);
    void setSky(const glm::vec3& radiance);
    void setEnvironment(const Environment& environment);
    void setBakedLight(std::shared_ptr<const BakedLight> baked);
    std::size_t addMesh(const Mesh& mesh);
    std::size_t addMesh(const gl::Device& device, const HostMesh& mesh);
    std::size_t addTexture(const Texture& texture);
    std::size_t addTexture(const gl::Device& device, const HostTexture& texture);
    std::size_t addMaterial(const Material& material);
    std::size_t addInstance(const Instance& instance);
    void removeInstance(std::size_t index);
    void removeMesh(std::size_t index);
    // Also before the first scene, and of those that follow.
    void setRegion(const Aabb& region);

  private:
    void requireInstance(const char* call, std::size_t index);
    // A mesh that is there, and the host's or not.
    void requireMesh(const char* call, std::size_t index, bool ofHost);

    std::optional<GpuScene> scene_;
    Aabb region_;
};

}  // namespace conelight::scene
