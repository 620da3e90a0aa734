// SPDX-License-Identifier: MIT
#include "gather/static_volume.h"

#include <algorithm>

#include "gl/pace.h"

namespace conelight::gather {
namespace {

// The scene without what moves, which keeps its index.
Scene staticsOf(const scene::GpuScene& scene) {
    Scene statics = scene.source();
    for (std::size_t i = 0; i < statics.instances.size(); ++i)
        statics.instances[i].visible = scene.isBaked(i);
    return statics;
}

}  // namespace

// Whether anything is baked.
bool StaticVolume::takeScene(const scene::GpuScene& scene) {
    std::vector<base::Revision> instances(scene.instances().size());
    for (std::size_t i = 0; i < instances.size(); ++i)
        if (scene.isBaked(i)) instances[i] = scene.instanceRevision(i);
    const bool any =
        std::any_of(instances.begin(), instances.end(), [](const auto& one) { return bool(one); });
    if (!any) {
        if (scene_) *this = {};  // frees all
        return false;
    }
    if (!scene_ || sceneFrom_ != scene.identity() || instancesFrom_ != instances) {
        scene_.reset();
        scene_.emplace(staticsOf(scene));
    } else if (lightsFrom_ != scene.lightRevision()) {
        scene_->setLights(scene.source().lights);
    }
    if (skyFrom_ != scene.skyRevision()) {
        scene_->setSky(scene.source().sky);
        scene_->setEnvironment(scene.source().environment);
    }
    sceneFrom_ = scene.identity();
    instancesFrom_ = std::move(instances);
    lightsFrom_ = scene.lightRevision();
    skyFrom_ = scene.skyRevision();
    return true;
}

base::Steps StaticVolume::updateInSteps(const gl::Device& device, const Inputs& inputs,
                                        const VoxelSettings& voxels, const ConesSettings& settings) {
    if (!takeScene(inputs.scene)) co_return;
    co_await lights_.updateInSteps(device, *scene_, inputs.wanted);
    co_await voxels_.updateInSteps(inputs.grid, device, *scene_, voxels);
    if (voxelsFrom_ != voxels_.revision() || bakedFrom_ != inputs.scene.bakedRevision())
        faces_.update(*inputs.scene.source().baked, voxels_.surface());
    voxelsFrom_ = voxels_.revision();
    bakedFrom_ = inputs.scene.bakedRevision();
    // The bake has all bounces.
    ConesSettings once = settings;
    once.bounces = std::min(settings.bounces, 1);
    co_await gl::rest(device);
    const ConeVolume::Inputs lit{*scene_, lights_, voxels_, nullptr, &faces_};
    co_await volume_.updateInSteps(device, lit, once);
    if (correctedFrom_ != volume_.revision() || correctedWith_ != settings) correct(device, settings);
}

void StaticVolume::correct(const gl::Device& device, const ConesSettings& settings) {
    light::LitFaces gathered;
    gathered.reserve(voxels_.surface().mostFaces());
    volume_.cones().gatherBounce(device, {lights_, volume_.volume(), voxels_.surface()}, gathered);
    faces_.correct(device, gathered);
    correctedFrom_ = volume_.revision();
    correctedWith_ = settings;
}

}  // namespace conelight::gather
