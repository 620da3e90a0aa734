// SPDX-License-Identifier: MIT
#include "modes/cones_mode.h"

namespace conelight::modes {
namespace {

using gather::ConeGather;

bool usesCache(const Settings& settings) { return settings.cones.indirect == ConesIndirect::Cache; }

}  // namespace

// [recipe]
base::Steps ConesMode::drawInSteps(const Frame& frame) {
    const Component component = frame.settings.component;
    const gather::PictureParts parts = gather::ConePicture::partsOf(frame.settings);
    const gather::DirectInputs pixels{frame.scene, frame.lights, frame.surfaces};
    const gather::ConePicture::Target target{frame.output, frame.lookupCounters};

    // Voxels, and all light in them, prefiltered.
    const bool softShadows = parts.direct && frame.settings.cones.shadows == ConesShadows::Cones;
    const bool usesVolume = softShadows || component == Component::Occlusion ||
                            component == Component::Voxels || parts.diffuse || parts.specular ||
                            frame.lights.castsCaustics() || frame.recorder != nullptr;
    if (usesVolume) co_await updateVolume(frame);

    // What arrives at pixels, and the picture.
    if (frame.recorder != nullptr) {
        record(frame);
    } else if (component == Component::Occlusion) {
        co_await picture_.drawOcclusion(frame.device, pixels, volume_, target);
    } else if (component == Component::Voxels) {
        drawVoxels(frame);
    } else {
        co_await picture_.drawInSteps(frame.device, pixels, volume_, parts, target);
    }
}
// [/recipe]

// By cones, where the picture holds what they may bring.
base::Steps ConesMode::drawGlass(const Frame& frame) {
    const gather::PictureParts parts = gather::ConePicture::partsOf(frame.settings);
    if (!frame.settings.cones.refraction || (!parts.diffuse && !parts.specular)) {
        co_await ModeRenderer::drawGlass(frame);
        co_return;
    }
    const gather::DirectInputs inputs{frame.scene, frame.lights, frame.surfaces};
    const gather::ConeShadows cones = volume_.cones().shadows(volume_.volume());
    co_await glass_.drawByCones(frame.device, inputs, cones, parts, frame.output);
}

void ConesMode::record(const Frame& frame) {
    const gather::DirectInputs pixels{frame.scene, frame.lights, frame.surfaces};
    if (frame.settings.component == Component::Occlusion)
        return picture_.record(frame.device, pixels, volume_, ConeGather::Part::Occlusion, *frame.recorder);
    if (frame.settings.cones.bounces == 0) return;
    picture_.record(frame.device, pixels, volume_, ConeGather::Part::Diffuse, *frame.recorder);
    picture_.record(frame.device, pixels, volume_, ConeGather::Part::Specular, *frame.recorder);
}

// With a cache, rays fill it first.
base::Steps ConesMode::updateVolume(const Frame& frame) {
    const bool byRays = usesCache(frame.settings);
    const bool rays = byRays || frame.lights.castsCaustics();
    if (byRays && !voxels_.areOf(frame.scene, frame.settings.voxels))
        co_await lit_.followVoxels(frame.device, voxels_);
    co_await voxels_.updateInSteps(frame.device, frame.scene, frame.settings.voxels,
                                   rays ? voxels::Rays::Yes : voxels::Rays::No);
    co_await frame.lights.castCausticsInSteps(frame.device, frame.scene, voxels_);
    if (byRays) {
        const light::LitVoxels::Inputs lit{frame.scene, frame.lights, voxels_};
        const light::RelightSettings relight = light::relightSettings(frame.settings.traced);
        co_await lit_.relightInSteps(frame.device, lit, relight, light::Budget{});
    } else {
        lit_ = {};
    }
    const gather::ConeVolume::Inputs inputs{frame.scene, frame.lights, voxels_, byRays ? &lit_ : nullptr};
    co_await volume_.updateInSteps(frame.device, inputs, frame.settings.cones);
}

// What the volume holds is shown as cones read it, the rest by the faces behind it.
void ConesMode::drawVoxels(const Frame& frame) {
    const image::VoxelView::Target target{frame.settings, frame.scene,  frame.lights,
                                          frame.surfaces, frame.output, frame.voxelsAmong};
    const VoxelData data = frame.settings.view.voxelData;
    if (data == VoxelData::Radiance || data == VoxelData::Coverage || data == VoxelData::Level)
        voxelView_.draw(frame.device, target, volume_.volume(), voxels_);
    else
        voxelView_.draw(
            frame.device, target,
            {voxels_, usesCache(frame.settings) ? lit_.faces() : volume_.faces(), volume_.revision()});
}

std::vector<gl::ProgramDesc> ConesMode::programDescs() {
    std::vector<gl::ProgramDesc> descs = gather::ConePicture::programDescs();
    for (const auto& more :
         {gather::RadianceVolume::programDescs(), gather::Glass::coneDescs(ConeGather::shadowDefines()),
          image::VoxelView::programDescs()})
        descs.insert(descs.end(), more.begin(), more.end());
    return descs;
}

}  // namespace conelight::modes
