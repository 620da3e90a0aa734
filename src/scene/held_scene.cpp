// SPDX-License-Identifier: MIT
#include "scene/held_scene.h"

#include <algorithm>
#include <cmath>
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
    if (!region_.empty()) scene_->setRegion(region_);
}

GpuScene& HeldScene::require(const char* call) {
    if (!scene_)
        base::fail(ErrorKind::Usage, "%s: there is no scene; setScene before it would be right", call);
    return *scene_;
}

void HeldScene::requireInstance(const char* call, std::size_t index) {
    requireIndex(call, "instance", index, require(call).source().instances.size());
    if (scene_->isRemovedInstance(index))
        base::fail(ErrorKind::Usage, "%s: instance %zu was removed; one that is there would be right", call,
                   index);
}

void HeldScene::setInstance(std::size_t index, const Instance& instance) {
    const Scene& source = require("setInstance").source();
    requireInstance("setInstance", index);
    validateInstance(source, instance, index);
    if (instance.mesh != source.instances[index].mesh)
        base::fail(ErrorKind::BadInput, "instance %zu '%s': mesh %d; the mesh it has, %d, would be right",
                   index, instance.name.c_str(), instance.mesh, source.instances[index].mesh);
    const gl::HostStateGuard guard;
    scene_->setInstance(index, instance);
}

void HeldScene::requireMesh(const char* call, std::size_t index, bool ofHost) {
    requireIndex(call, "mesh", index, require(call).source().meshes.size());
    if (scene_->isRemovedMesh(index))
        base::fail(ErrorKind::Usage, "%s: mesh %zu was removed; one that is there would be right", call,
                   index);
    if (scene_->isHostMesh(index) != ofHost)
        base::fail(ErrorKind::Usage, "%s: mesh %zu came %s; the same again would be right", call, index,
                   ofHost ? "as arrays" : "in buffers of the host");
}

void HeldScene::setMesh(std::size_t index, const Mesh& mesh) {
    const Scene& source = require("setMesh").source();
    requireMesh("setMesh", index, false);
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

void HeldScene::setMesh(const gl::Device& device, std::size_t index, const HostMesh& mesh) {
    const Scene& source = require("setMesh").source();
    requireMesh("setMesh", index, true);
    const gl::HostStateGuard guard;
    requireUsable(mesh);
    const std::uint32_t vertices = scene_->vertexCount(index), indices = scene_->indexCount(index);
    if (packedVertices(mesh) != vertices || mesh.indexCount != indices)
        base::fail(ErrorKind::BadInput,
                   "mesh %zu '%s' of the host: %u vertices and %u indices; as many as it has, %u and %u, "
                   "would be right",
                   index, mesh.name.c_str(), packedVertices(mesh), mesh.indexCount, vertices, indices);
    validateReaches(source, index, mesh.bounds);
    scene_->setMesh(device, index, mesh);
}

void HeldScene::setTexture(std::size_t index, const Texture& texture) {
    requireIndex("setTexture", "texture", index, require("setTexture").source().textures.size());
    validateTexture(texture);
    const gl::HostStateGuard guard;
    scene_->setTexture(index, texture);
}

void HeldScene::setTexture(const gl::Device& device, std::size_t index, const HostTexture& texture) {
    requireIndex("setTexture", "texture", index, require("setTexture").source().textures.size());
    const gl::HostStateGuard guard;
    requireUsable(texture);
    scene_->setTexture(device, index, texture);
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

std::size_t HeldScene::addMesh(const Mesh& mesh) {
    validateMesh(mesh, require("addMesh").source().meshes.size());
    const gl::HostStateGuard guard;
    return scene_->addMesh(mesh);
}

std::size_t HeldScene::addMesh(const gl::Device& device, const HostMesh& mesh) {
    require("addMesh");
    const gl::HostStateGuard guard;
    requireUsable(mesh);
    return scene_->addMesh(device, mesh);
}

std::size_t HeldScene::addTexture(const Texture& texture) {
    require("addTexture");
    validateTexture(texture);
    const gl::HostStateGuard guard;
    return scene_->addTexture(texture);
}

std::size_t HeldScene::addTexture(const gl::Device& device, const HostTexture& texture) {
    require("addTexture");
    const gl::HostStateGuard guard;
    requireUsable(texture);
    return scene_->addTexture(device, texture);
}

std::size_t HeldScene::addMaterial(const Material& material) {
    validateMaterial(require("addMaterial").source(), material);
    const gl::HostStateGuard guard;
    return scene_->addMaterial(material);
}

std::size_t HeldScene::addInstance(const Instance& instance) {
    const Scene& source = require("addInstance").source();
    validateInstance(source, instance, source.instances.size());
    if (scene_->isRemovedMesh(static_cast<std::size_t>(instance.mesh)))
        base::fail(ErrorKind::BadInput,
                   "instance '%s': mesh %d was removed; one that is there would be right",
                   instance.name.c_str(), instance.mesh);
    const gl::HostStateGuard guard;
    return scene_->addInstance(instance);
}

void HeldScene::removeInstance(std::size_t index) {
    requireInstance("removeInstance", index);
    const gl::HostStateGuard guard;
    scene_->removeInstance(index);
}

void HeldScene::removeMesh(std::size_t index) {
    const Scene& source = require("removeMesh").source();
    requireIndex("removeMesh", "mesh", index, source.meshes.size());
    if (scene_->isRemovedMesh(index))
        base::fail(ErrorKind::Usage, "removeMesh: mesh %zu was removed; one that is there would be right",
                   index);
    for (std::size_t i = 0; i < source.instances.size(); ++i)
        if (!scene_->isRemovedInstance(i) && source.instances[i].mesh == static_cast<int>(index))
            base::fail(ErrorKind::Usage,
                       "removeMesh: instance %zu has mesh %zu; removeInstance before it would be right", i,
                       index);
    scene_->removeMesh(index);
}

void HeldScene::setRegion(const Aabb& region) {
    const glm::vec3 extent = region.extent();
    const float least = std::min({extent.x, extent.y, extent.z}),
                most = std::max({extent.x, extent.y, extent.z});
    if (!region.empty() && !(least >= 0 && most > 0 && std::isfinite(most)))
        base::fail(ErrorKind::BadInput,
                   "setRegion: a box of %g x %g x %g m; a finite one with an extent, or an empty "
                   "one for none, would be right",
                   static_cast<double>(extent.x), static_cast<double>(extent.y),
                   static_cast<double>(extent.z));
    region_ = region;
    if (scene_) scene_->setRegion(region);
}

}  // namespace conelight::scene
