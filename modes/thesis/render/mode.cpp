// SPDX-License-Identifier: MIT
#include "thesis/render/mode.h"

#include "conelight/thesis/thesis.h"
#include "gl/gl.h"

namespace conelight::thesis {
namespace {

ThesisVolumeOptions volumeOptions(const modes::Frame& frame) {
    ThesisVolumeOptions options;
    options.size = frame.settings.voxels.size;
    options.padding = frame.settings.voxels.padding;
    options.shift = frame.settings.voxels.shift;
    options.defects = effectiveDefects(frame.settings.groups.of<ThesisSettings>());
    options.storage = frame.settings.groups.of<ThesisSettings>().storage;
    options.along = frame.settings.groups.of<ThesisSettings>().voxelizeAlong;
    options.filter = frame.settings.groups.of<ThesisSettings>().filter;
    options.unitGrid = frame.scene.source().format == kSceneFormat && options.defects.wholeGrid;
    options.shadows = !options.defects.unshadowedVoxels && frame.settings.light.shadowSize > 0;
    const light::LightKey key = frame.lights.key();
    options.lights = options.shadows ? key : light::LightKey{.shaped = key.shaped};
    const ThesisSettings& own = frame.settings.groups.of<ThesisSettings>();
    const bool gathers = own.voxDiffuse && (own.frontCone || own.intermediateCones || own.sideCones);
    if (gathers && own.bounces > 1) {
        options.bounces = own.bounces;
        // What bounceDesc and the diffuse part of thesisConstants read.
        options.cones.defects = options.defects;
        options.cones.storage = own.storage;
        options.cones.diffuse = own.diffuse;
        options.cones.diffuseOriginOffset = own.diffuseOriginOffset;
        options.cones.frontCone = own.frontCone;
        options.cones.intermediateCones = own.intermediateCones;
        options.cones.sideCones = own.sideCones;
        options.cones.maxSamples = own.maxSamples;
    }
    return options;
}

}  // namespace

bool ThesisMode::needsShadows(const Scene&, const Settings& settings) const {
    return settings.light.shadowSize > 0 &&
           !effectiveDefects(settings.groups.of<ThesisSettings>()).unshadowedVoxels;
}

bool ThesisMode::lightsFromEmitters(const Settings& settings) const {
    return !effectiveDefects(settings.groups.of<ThesisSettings>()).darkEmitters;
}

void ThesisMode::updateVolume(const modes::Frame& frame) {
    const ThesisVolumeOptions options = volumeOptions(frame);
    if (sceneFrom_ == frame.scene.geometryRevision() && lightsFrom_ == frame.lights.revision() &&
        options_ == options)
        return;
    volume_.build(frame.device, {frame.scene, frame.lights}, options);
    sceneFrom_ = frame.scene.geometryRevision();
    lightsFrom_ = frame.lights.revision();
    options_ = options;
}

void ThesisMode::draw(const modes::Frame& frame) {
    updateVolume(frame);
    const gather::DirectInputs pixels{frame.scene, frame.lights, frame.surfaces};
    if (frame.recorder != nullptr)
        cones_.record(frame.device, {pixels, volume_, frame.settings}, frame.output, *frame.recorder);
    else if (frame.settings.component == Component::Voxels)
        drawVoxels(frame);
    else
        cones_.draw(frame.device, {pixels, volume_, frame.settings}, frame.output, frame.lookupCounters);
}

void ThesisMode::drawVoxels(const modes::Frame& frame) {
    const gpu::ThesisGrid& grid = volume_.grid();
    const ThesisSettings& own = frame.settings.groups.of<ThesisSettings>();
    const image::VoxelVolume volume{
        .texture = volume_.texture(),
        .octree = volume_.octree(),
        .sampler = volume_.sampler(),
        .origin = grid.origin,
        .voxelSize = grid.voxelSize,
        .size = static_cast<int>(grid.size),
        .maxLevel = static_cast<int>(grid.maxLevel),
        .filledMin = glm::ivec3(grid.boxMin),
        .filledSize = glm::ivec3(grid.boxSize),
        .zeroMeansEmpty = volume_.texture().desc().format == GL_RGBA16F && grid.maxLevel >= 2,
        .level = own.voxelLevel,
        .onSurfaces = own.voxelView == ThesisVoxelView::Surfaces,
        .revision = volume_.revision()};
    voxelView_.draw(
        frame.device,
        {frame.settings, frame.scene, frame.lights, frame.surfaces, frame.output, frame.voxelsAmong}, volume);
}

std::vector<gl::ProgramDesc> ThesisMode::programDescs() {
    std::vector<gl::ProgramDesc> descs = ThesisVolume::programDescs();
    const std::vector<gl::ProgramDesc> cones = ThesisConePass::programDescs();
    descs.insert(descs.end(), cones.begin(), cones.end());
    return descs;
}

}  // namespace conelight::thesis
