// SPDX-License-Identifier: MIT
#include "modes/thesis_mode.h"

#include "conelight/thesis/settings.h"
namespace conelight::modes {
namespace {

voxels::ThesisVolumeOptions volumeOptions(const FrameContext& frame) {
    voxels::ThesisVolumeOptions options;
    options.size = frame.settings.voxels.size;
    options.padding = frame.settings.voxels.padding;
    options.shift = frame.settings.voxels.shift;
    options.defects = gather::effectiveDefects(frame.settings.groups.of<thesis::ThesisSettings>());
    options.unitGrid = frame.source.thesisFormat && options.defects.wholeGrid;
    options.shadows = !options.defects.unshadowedVoxels && frame.settings.light.shadowSize > 0;
    if (options.shadows) options.lightDefines = light::lightDefines(frame.scene, frame.settings.light);
    return options;
}

}  // namespace

bool ThesisMode::needsShadows(const Settings& settings) const {
    return settings.light.shadowSize > 0 &&
           !gather::effectiveDefects(settings.groups.of<thesis::ThesisSettings>()).unshadowedVoxels;
}

void ThesisMode::updateVolume(const FrameContext& frame) {
    const voxels::ThesisVolumeOptions options = volumeOptions(frame);
    if (frame.geometryChanged || frame.lightChanged || builtFor_ != options) {
        volume_.build(frame.programs, frame.profiler, frame.scene, options);
        voxelView_.voxelsChanged();
        builtFor_ = options;
    }
}

void ThesisMode::record(const FrameContext& frame, gather::StepRecorder& recorder) {
    updateVolume(frame);
    cones_.record(frame.programs, frame.scene, frame.gbuffer, volume_, frame.settings, recorder);
}

void ThesisMode::render(const FrameContext& frame) {
    updateVolume(frame);
    if (frame.settings.component == Component::Voxels) {
        frame.gbuffer.bind();
        return voxelView_.draw(
            {frame.programs, frame.profiler, frame.settings, frame.view, frame.output, frame.voxelsAmong},
            volume_);
    }
    cones_.render(frame.programs, frame.profiler, frame.scene, frame.gbuffer, volume_, frame.settings,
                  frame.output, frame.lookupCounters);
}

std::vector<gl::ProgramDesc> ThesisMode::programDescs() {
    std::vector<gl::ProgramDesc> descs = voxels::ThesisVolume::programDescs();
    const std::vector<gl::ProgramDesc> cones = gather::ThesisConePass::programDescs();
    descs.insert(descs.end(), cones.begin(), cones.end());
    return descs;
}

}  // namespace conelight::modes
