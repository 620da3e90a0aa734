// SPDX-License-Identifier: MIT
#include "scene/held_scene.h"

#include <utility>

#include "base/log.h"
#include "gl/host_state.h"
#include "scene/scene_checks.h"

namespace conelight::scene {
namespace {

void requireIndex(const char* call, const char* what, std::size_t index, std::size_t count) {
    if (index >= count)
        base::fail(ErrorKind::Usage, "%s: %s %zu of %zu; an index below that would be right", call, what,
                   index, count);
}

}  // namespace

void HeldScene::set(const Scene& scene) {
    scene_.reset();
    scene_.emplace(scene);
}

GpuScene& HeldScene::require(const char* call) {
    if (!scene_)
        base::fail(ErrorKind::Usage, "%s: there is no scene; setScene before it would be right", call);
    return *scene_;
}

void HeldScene::setInstance(std::size_t index, const Instance& instance) {
    const Scene& source = require("setInstance").source();
    requireIndex("setInstance", "instance", index, source.instances.size());
    validateInstance(source, instance, index);
    if (instance.mesh != source.instances[index].mesh)
        base::fail(ErrorKind::BadInput, "instance %zu '%s': mesh %d; the mesh it has, %d, would be right",
                   index, instance.name.c_str(), instance.mesh, source.instances[index].mesh);
    const gl::HostStateGuard guard;
    scene_->setInstance(index, instance);
}

void HeldScene::setMesh(std::size_t index, const Mesh& mesh) {
    const Scene& source = require("setMesh").source();
    requireIndex("setMesh", "mesh", index, source.meshes.size());
    validateMesh(mesh, index);
    const Mesh& old = source.meshes[index];
    if (mesh.positions.size() != old.positions.size() || mesh.indices.size() != old.indices.size())
        base::fail(
            ErrorKind::BadInput,
            "mesh %zu '%s': %zu vertices and %zu indices; as many as it has, %zu and %zu, would be right",
            index, mesh.name.c_str(), mesh.positions.size(), mesh.indices.size(), old.positions.size(),
            old.indices.size());
    if (mesh.normals.empty() != old.normals.empty())
        base::fail(ErrorKind::BadInput, "mesh %zu '%s': %s normals; normals %s, as it has, would be right",
                   index, mesh.name.c_str(), mesh.normals.empty() ? "no" : "has",
                   old.normals.empty() ? "left out" : "for every vertex");
    validateReaches(source, index, mesh.bounds());
    const gl::HostStateGuard guard;
    scene_->setMesh(index, mesh);
}

void HeldScene::setMaterial(std::size_t index, const Material& material) {
    const Scene& source = require("setMaterial").source();
    requireIndex("setMaterial", "material", index, source.materials.size());
    validateMaterial(source, material);
    const gl::HostStateGuard guard;
    scene_->setMaterial(index, material);
}

void HeldScene::setLight(std::size_t index, const Light& light) {
    std::vector<Light> lights = require("setLight").source().lights;
    requireIndex("setLight", "light", index, lights.size());
    lights[index] = light;
    setLights(lights);
}

void HeldScene::setLights(const std::vector<Light>& lights) {
    require("setLights");
    for (const Light& light : lights) validateLight(light);
    scene_->setLights(lights);
}

void HeldScene::setSky(const glm::vec3& radiance) {
    require("setSky");
    validateSky(radiance);
    scene_->setSky(radiance);
}

void HeldScene::setEnvironment(const Environment& environment) {
    require("setEnvironment");
    validateEnvironment(environment);
    scene_->setEnvironment(environment);
}

void HeldScene::setBakedLight(std::shared_ptr<const BakedLight> baked) {
    const Scene& source = require("setBakedLight").source();
    if (source.baked == baked) return;
    if (baked != nullptr) validateBakedLight(source, *baked);
    const gl::HostStateGuard guard;
    scene_->setBakedLight(std::move(baked));
}

}  // namespace conelight::scene
