// SPDX-License-Identifier: MIT
#include "modes/hybrid_mode.h"

namespace conelight::modes {
namespace {

using gather::ConeGather;

bool movesAnything(const scene::GpuScene& scene) {
    bool moves = false;
    for (std::size_t i = 0; i < scene.instances().size(); ++i)
        moves = moves || ((scene.instances()[i].flags & INSTANCE_VISIBLE) != 0 && !scene.isBaked(i));
    return moves;
}

}  // namespace

// [recipe]
void HybridMode::draw(const Frame& frame) {
    const Component component = frame.settings.component;
    const gather::PictureParts parts = gather::ConePicture::partsOf(frame.settings);
    const gather::DirectInputs pixels{frame.scene, frame.lights, frame.surfaces};

    // Voxels of what does not move and of all, with the light that they send out.
    updateVolumes(frame);

    if (frame.recorder != nullptr) return record(frame);
    if (component == Component::Voxels) return drawVoxels(frame);
    gather::ConePicture::Target target{frame.output, frame.lookupCounters};
    if (component == Component::Occlusion)
        return picture_.drawOcclusion(frame.device, pixels, shown(), target);

    // Baked light and what moving things make of it; all else as in mode cones.
    if (parts.diffuse && statics_) {
        diffuse_.draw(frame.device, {pixels, statics_, moves_ ? &volume_ : nullptr}, frame.lookupCounters);
        target.diffuse = &diffuse_.irradiance();
    }
    picture_.draw(frame.device, pixels, shown(), parts, target);
}
// [/recipe]

void HybridMode::updateVolumes(const Frame& frame) {
    const Settings& settings = frame.settings;
    const voxels::VoxelGrid grid = voxels::SurfaceVoxels::gridOf(frame.scene, settings.voxels);
    statics_.update(frame.device, {frame.scene, grid, {settings.light, settings.light.emissiveQuads, true}},
                    settings.voxels, settings.cones);
    moves_ = !statics_ || movesAnything(frame.scene);
    if (!moves_) return;
    voxels_.update(frame.device, frame.scene, settings.voxels, voxels::Rays::No);
    volume_.update(frame.device,
                   {frame.scene, frame.lights, voxels_, nullptr, statics_ ? &statics_.faces() : nullptr},
                   settings.cones);
}

// Cones through the volume of what is there: without what was baked.
void HybridMode::record(const Frame& frame) {
    const gather::DirectInputs pixels{frame.scene, frame.lights, frame.surfaces};
    if (frame.settings.component == Component::Occlusion)
        return picture_.record(frame.device, pixels, shown(), ConeGather::Part::Occlusion, *frame.recorder);
    picture_.record(frame.device, pixels, shown(), ConeGather::Part::Diffuse, *frame.recorder);
    picture_.record(frame.device, pixels, shown(), ConeGather::Part::Specular, *frame.recorder);
}

// As in mode cones.
void HybridMode::drawVoxels(const Frame& frame) {
    const image::VoxelView::Target target{frame.settings, frame.scene,  frame.lights,
                                          frame.surfaces, frame.output, frame.voxelsAmong};
    const voxels::Voxels& voxels = moves_ ? voxels_ : statics_.voxels();
    const VoxelData data = frame.settings.view.voxelData;
    if (data == VoxelData::Radiance || data == VoxelData::Coverage || data == VoxelData::Level)
        voxelView_.draw(frame.device, target, shown().volume(), voxels);
    else
        voxelView_.draw(frame.device, target, {voxels, shown().faces(), shown().revision()});
}

std::vector<gl::ProgramDesc> HybridMode::programDescs() {
    std::vector<gl::ProgramDesc> descs = gather::HybridDiffuse::programDescs();
    for (const auto& more : {light::BakedFaces::programDescs(), gather::ConePicture::programDescs(),
                             gather::RadianceVolume::programDescs(), image::VoxelView::programDescs()})
        descs.insert(descs.end(), more.begin(), more.end());
    return descs;
}

}  // namespace conelight::modes
