// SPDX-License-Identifier: MIT
#include "modes/cones_mode.h"

namespace conelight::modes {
namespace {

using gather::ConeGather;

// Nothing is gathered without a bounce; the parts are black then.
gather::PictureParts partsOf(const Settings& settings) {
    gather::PictureParts parts = gather::partsOf(settings.component);
    const bool gathers = settings.cones.bounces > 0;
    return {parts.direct, parts.diffuse && gathers, parts.specular && gathers};
}

}  // namespace

// [recipe]
void ConesMode::draw(const Frame& frame) {
    const Component component = frame.settings.component;
    const gather::PictureParts parts = partsOf(frame.settings);
    const gather::DirectInputs pixels{frame.scene, frame.lights, frame.surfaces};
    const gather::ConePicture::Target target{frame.output, frame.lookupCounters};

    // Voxels, and all light in them, prefiltered.
    const bool usesVolume = component == Component::Occlusion || component == Component::Voxels ||
                            parts.diffuse || parts.specular || frame.recorder != nullptr;
    if (usesVolume) {
        voxels_.update(frame.device, frame.scene, frame.settings.voxels, voxels::Rays::No);
        volume_.update(frame.device, {frame.scene, frame.lights, voxels_}, frame.settings.cones);
    }

    // What arrives at pixels, and the picture.
    if (frame.recorder != nullptr) {
        if (component == Component::Occlusion)
            return picture_.record(frame.device, pixels, volume_, ConeGather::Part::Occlusion,
                                   *frame.recorder);
        if (frame.settings.cones.bounces == 0) return;
        picture_.record(frame.device, pixels, volume_, ConeGather::Part::Diffuse, *frame.recorder);
        picture_.record(frame.device, pixels, volume_, ConeGather::Part::Specular, *frame.recorder);
    } else if (component == Component::Occlusion) {
        picture_.drawOcclusion(frame.device, pixels, volume_, target);
    } else if (component == Component::Voxels) {
        drawVoxels(frame);
    } else {
        picture_.draw(frame.device, pixels, volume_, parts, target);
    }
}
// [/recipe]

// What the volume holds is shown as cones read it, the rest by the faces behind it.
void ConesMode::drawVoxels(const Frame& frame) {
    const image::VoxelView::Target target{frame.settings, frame.scene,  frame.lights,
                                          frame.surfaces, frame.output, frame.voxelsAmong};
    const VoxelData data = frame.settings.view.voxelData;
    if (data == VoxelData::Radiance || data == VoxelData::Coverage || data == VoxelData::Level)
        voxelView_.draw(frame.device, target, volume_.volume(), voxels_);
    else
        voxelView_.draw(frame.device, target, {voxels_, volume_.faces(), volume_.revision()});
}

std::vector<gl::ProgramDesc> ConesMode::programDescs() {
    std::vector<gl::ProgramDesc> descs = gather::ConePicture::programDescs();
    for (const auto& more : {gather::RadianceVolume::programDescs(), image::VoxelView::programDescs()})
        descs.insert(descs.end(), more.begin(), more.end());
    return descs;
}

}  // namespace conelight::modes
