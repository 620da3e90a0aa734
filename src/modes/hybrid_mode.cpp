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
base::Steps HybridMode::drawInSteps(const Frame& frame) {
    const Component component = frame.settings.component;
    const gather::PictureParts parts = gather::ConePicture::partsOf(frame.settings);
    const gather::DirectInputs pixels{frame.scene, frame.lights, frame.surfaces};

    // Voxels of what does not move and of all, with the light that they send out.
    co_await updateVolumes(frame);

    gather::ConePicture::Target target{frame.output, frame.lookupCounters};
    if (frame.recorder != nullptr) {
        record(frame);
    } else if (component == Component::Voxels) {
        drawVoxels(frame);
    } else if (component == Component::Occlusion) {
        co_await picture_.drawOcclusion(frame.device, pixels, shown(), target);
    } else {
        // Baked light and what moving things make of it; all else as in mode cones.
        if (parts.diffuse && statics_) {
            const gather::HybridDiffuse::Inputs inputs{pixels, statics_, moves_ ? &volume_ : nullptr};
            co_await diffuse_.drawInSteps(frame.device, inputs, frame.lookupCounters);
            target.diffuse = &diffuse_.irradiance();
        }
        co_await picture_.drawInSteps(frame.device, pixels, shown(), parts, target);
    }
}
// [/recipe]

base::Steps HybridMode::updateVolumes(const Frame& frame) {
    const Settings& settings = frame.settings;
    const voxels::VoxelGrid grid = voxels::SurfaceVoxels::gridOf(frame.scene, settings.voxels);
    const light::LightsWanted wanted{settings.light, settings.light.emissiveQuads, true};
    const gather::StaticVolume::Inputs inputs{frame.scene, grid, wanted};
    co_await statics_.updateInSteps(frame.device, inputs, settings.voxels, settings.cones);
    moves_ = !statics_ || movesAnything(frame.scene);
    if (!moves_) co_return;
    co_await voxels_.updateInSteps(frame.device, frame.scene, settings.voxels, voxels::Rays::No);
    const gather::ConeVolume::Inputs all{frame.scene, frame.lights, voxels_, nullptr,
                                         statics_ ? &statics_.faces() : nullptr};
    co_await volume_.updateInSteps(frame.device, all, settings.cones);
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
