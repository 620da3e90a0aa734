// SPDX-License-Identifier: MIT
#include "gather/cone_volume.h"

#include "gl/pace.h"
#include "light/inject_light.h"

namespace conelight::gather {

namespace {

// Of what the volume takes from baked light: corrections belong to bounces.
base::Revision bakedRevision(const light::BakedFaces* baked, const ConesSettings& settings) {
    if (baked == nullptr) return {};
    return settings.bounces > 1 ? baked->correctionRevision() : baked->revision();
}

}  // namespace

base::Steps ConeVolume::updateInSteps(const gl::Device& device, const Inputs& inputs,
                                      ConesSettings settings) {
    const voxels::SurfaceVoxels& surface = inputs.voxels.surface();
    const RadianceLayout layout =
        radianceLayout(surface.grid(), settings.directional, settings.maxFootprint, settings.storage);
    const bool otherLayout = !volume_.laidOut() || !(volume_.layout() == layout);
    const base::Revision lights =
        inputs.cache != nullptr ? inputs.cache->revision() : inputs.lights.revision();
    const base::Revision baked = bakedRevision(inputs.baked, settings);
    const bool otherSources =
        voxelsFrom_ != inputs.voxels.revision() || lightsFrom_ != lights || bakedFrom_ != baked;
    const bool otherSettings = !settings_ || !(*settings_ == settings);
    // How light is gathered at faces is part of the volume when there is more than one bounce.
    const bool otherBounces =
        otherSettings && (settings.bounces > 1 || (settings_ && settings_->bounces > 1));
    const bool otherOpacity = !settings_ || settings_->opacity != settings.opacity;
    if (otherSettings || otherSources || otherLayout) cones_.configure(settings, layout);
    settings_ = settings;
    if (!otherLayout && !otherSources && !otherBounces && !otherOpacity) co_return;
    voxelsFrom_ = {};

    if (otherLayout) {
        volume_ = {};  // frees the old one first
        volume_ = RadianceVolume(layout);
    }
    revision_ = base::Revision::next();
    if (inputs.cache != nullptr)
        co_await volume_.buildInSteps(device, surface, inputs.cache->faces(), settings.opacity);
    else
        co_await light(device, inputs, settings);
    voxelsFrom_ = inputs.voxels.revision();
    lightsFrom_ = lights;
    bakedFrom_ = baked;
}

// Without a cache: direct and baked light, and bounces.
base::Steps ConeVolume::light(const gl::Device& device, const Inputs& inputs, const ConesSettings& settings) {
    const voxels::SurfaceVoxels& surface = inputs.voxels.surface();
    light::injectLight(device, {inputs.scene, inputs.lights, surface}, faces_);
    co_await gl::rest(device);
    if (inputs.baked != nullptr) inputs.baked->light(device, surface, faces_, corrections_);
    const gl::Buffer* corrections = inputs.baked != nullptr ? &corrections_ : nullptr;
    co_await volume_.buildInSteps(device, surface, faces_, settings.opacity);
    // Each further bounce reads the volume with one bounce less.
    for (int bounce = 1; bounce < settings.bounces; ++bounce) {
        cones_.gatherBounce(device, {inputs.lights, volume_, surface, corrections}, faces_);
        co_await gl::rest(device);
        co_await volume_.buildInSteps(device, surface, faces_, settings.opacity);
    }
}

}  // namespace conelight::gather
