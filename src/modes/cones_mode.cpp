// SPDX-License-Identifier: MIT
#include "modes/cones_mode.h"

#include <optional>

#include "gather/cone_gather.h"
#include "gather/direct_light.h"
#include "gather/picture_parts.h"
#include "gather/voxel_view.h"
#include "gl/gl.h"
#include "light/inject_light.h"
#include "shared/bindings.h"
#include "voxels/radiance_volume.h"

namespace conelight::modes {
namespace {

// Texture units of gather/cone_compose.comp.glsl.
constexpr unsigned kUnitDirectDiffuse = UNIT_PASS + 1;
constexpr unsigned kUnitDirectSpecular = UNIT_PASS + 2;
constexpr unsigned kUnitDiffuse = UNIT_PASS + 3;
constexpr unsigned kUnitSpecular = UNIT_PASS + 4;

gl::ProgramDesc composeDesc(const gather::PictureParts& parts) {
    return {{"gather/cone_compose.comp.glsl"},
            {{"SHOW_DIRECT", parts.direct ? "1" : "0"},
             {"SHOW_DIFFUSE", parts.diffuse ? "1" : "0"},
             {"SHOW_SPECULAR", parts.specular ? "1" : "0"}}};
}

gl::ProgramDesc occlusionDesc() { return {{"gather/cone_occlusion.comp.glsl"}, {}}; }

}  // namespace

struct ConesMode::Impl {
    voxels::SurfaceVoxels surface;
    voxels::RadianceVolume volume;
    gather::ConeGather cones;
    gather::DirectLight direct;
    gather::VoxelView voxelView;
    // Pictures of what was gathered, of the frame's size.
    gl::Texture diffuse, specular;

    // What the voxels and the volume were made for, and what has changed since.
    bool geometryDirty = true;
    bool lightDirty = true;
    bool volumeDirty = true;
    std::optional<ConesSettings> configuredFor;

    void updateVolume(const FrameContext& frame);
    void resize(gl::Texture& picture, const FrameContext& frame, const char* label);
    void drawOcclusion(const FrameContext& frame);
    void drawVoxels(const FrameContext& frame);
    void drawParts(const FrameContext& frame, const gather::PictureParts& parts);
};

// Brings voxels, their light and the volume up to date.
void ConesMode::Impl::updateVolume(const FrameContext& frame) {
    const ConesSettings& settings = frame.settings.cones;
    if (geometryDirty) {
        if (frame.everythingAnew)
            surface.build(frame.programs, frame.profiler, frame.scene, frame.settings.voxels);
        else
            surface.update(frame.programs, frame.profiler, frame.scene, frame.settings.voxels);
        voxelView.voxelsChanged();
        lightDirty = true;
    }
    const voxels::RadianceLayout layout =
        voxels::radianceLayout(surface.grid(), settings.directional, settings.maxFootprint);
    if (!volume.texture() || !(volume.layout() == layout)) {
        volume = {};  // frees the old one first
        volume = voxels::RadianceVolume(layout);
        volumeDirty = true;
        configuredFor.reset();
    }
    if (!configuredFor || !(*configuredFor == settings) || geometryDirty) {
        // How light is gathered at faces is part of the volume when there is more than one bounce.
        const bool gathered = settings.bounces > 1 || (configuredFor && configuredFor->bounces > 1);
        if (gathered) lightDirty = true;
        if (!configuredFor || configuredFor->opacity != settings.opacity) volumeDirty = true;
        cones.configure(settings, layout);
        configuredFor = settings;
    }
    if (lightDirty)
        light::injectLight(frame.programs, frame.profiler, frame.scene, frame.settings.light, surface);
    if (lightDirty || volumeDirty) {
        voxelView.lightChanged();
        volume.build(frame.programs, frame.profiler, surface, settings.opacity);
        // Each further bounce reads the volume with one bounce less.
        for (int bounce = 1; bounce < settings.bounces; ++bounce) {
            cones.gatherBounce(frame.programs, frame.profiler, volume, surface);
            volume.build(frame.programs, frame.profiler, surface, settings.opacity);
        }
    }
    geometryDirty = lightDirty = volumeDirty = false;
}

void ConesMode::Impl::resize(gl::Texture& picture, const FrameContext& frame, const char* label) {
    if (picture && picture.width() == frame.width && picture.height() == frame.height) return;
    picture = {};
    picture = gl::Texture({GL_TEXTURE_2D, GL_RGBA16F, frame.width, frame.height}, label);
}

void ConesMode::Impl::drawOcclusion(const FrameContext& frame) {
    resize(diffuse, frame, "gathered diffuse");
    cones.gatherOcclusion(frame.programs, frame.profiler, volume, diffuse, frame.lookupCounters);
    gl::barrier(gl::Access::TextureFetch);
    const gl::PassScope pass(frame.profiler, "compose");
    diffuse.bind(kUnitDiffuse);
    frame.output.bindImage(0, 0, GL_WRITE_ONLY);
    frame.programs.get(occlusionDesc()).dispatch(frame.width, frame.height);
}

// What the volume holds is shown as cones read it, the rest by the faces behind it.
void ConesMode::Impl::drawVoxels(const FrameContext& frame) {
    const gather::VoxelView::Target target{frame.programs, frame.profiler, frame.settings,
                                           frame.view,     frame.output,   frame.voxelsAmong};
    const VoxelData data = frame.settings.view.voxelData;
    if (data == VoxelData::Radiance || data == VoxelData::Coverage || data == VoxelData::Level)
        voxelView.draw(target, volume, surface);
    else
        voxelView.draw(target, surface, false);
}

void ConesMode::Impl::drawParts(const FrameContext& frame, const gather::PictureParts& parts) {
    // Nothing is gathered without a bounce; the parts are black then.
    const bool gathers = frame.settings.cones.bounces > 0;
    const gather::PictureParts shown{parts.direct, parts.diffuse && gathers, parts.specular && gathers};
    if (shown.direct)
        direct.draw(frame.programs, frame.profiler, frame.scene, frame.settings.light, frame.width,
                    frame.height);
    if (shown.diffuse) {
        resize(diffuse, frame, "gathered diffuse");
        cones.gatherDiffuse(frame.programs, frame.profiler, volume, diffuse, frame.lookupCounters);
    }
    if (shown.specular) {
        resize(specular, frame, "gathered specular");
        cones.gatherSpecular(frame.programs, frame.profiler, volume, specular, frame.lookupCounters);
    }
    gl::barrier(gl::Access::TextureFetch);

    const gl::PassScope pass(frame.profiler, "compose");
    if (shown.direct) {
        direct.diffuse().bind(kUnitDirectDiffuse);
        direct.specular().bind(kUnitDirectSpecular);
    }
    if (shown.diffuse) diffuse.bind(kUnitDiffuse);
    if (shown.specular) specular.bind(kUnitSpecular);
    frame.output.bindImage(0, 0, GL_WRITE_ONLY);
    frame.programs.get(composeDesc(shown)).dispatch(frame.width, frame.height);
}

ConesMode::ConesMode() : impl_(std::make_unique<Impl>()) {}
ConesMode::~ConesMode() = default;

// Every component that this mode draws has lit voxels or direct light in it, or leaves them behind for the
// next.
bool ConesMode::needsShadows(const Settings&) const { return true; }

void ConesMode::render(const FrameContext& frame) {
    impl_->geometryDirty = impl_->geometryDirty || frame.geometryChanged;
    impl_->lightDirty = impl_->lightDirty || frame.lightChanged;
    const Component component = frame.settings.component;
    const gather::PictureParts parts = gather::partsOf(component);
    const bool usesVolume = component == Component::Occlusion || component == Component::Voxels ||
                            ((parts.diffuse || parts.specular) && frame.settings.cones.bounces > 0);
    if (usesVolume) impl_->updateVolume(frame);
    frame.gbuffer.bind(UNIT_GBUFFER);
    switch (component) {
        case Component::Occlusion:
            impl_->drawOcclusion(frame);
            break;
        case Component::Voxels:
            impl_->drawVoxels(frame);
            break;
        default:
            impl_->drawParts(frame, parts);
    }
}

void ConesMode::record(const FrameContext& frame, gather::StepRecorder& recorder) {
    using Recorded = gather::ConeGather::Recorded;
    Impl& m = *impl_;
    m.geometryDirty = m.geometryDirty || frame.geometryChanged;
    m.lightDirty = m.lightDirty || frame.lightChanged;
    m.updateVolume(frame);
    frame.gbuffer.bind(UNIT_GBUFFER);
    m.resize(m.diffuse, frame, "gathered diffuse");
    if (frame.settings.component == Component::Occlusion)
        return m.cones.record(frame.programs, m.volume, m.diffuse, Recorded::Occlusion, recorder);
    if (frame.settings.cones.bounces == 0) return;
    m.cones.record(frame.programs, m.volume, m.diffuse, Recorded::Diffuse, recorder);
    m.cones.record(frame.programs, m.volume, m.diffuse, Recorded::Specular, recorder);
}

std::vector<gl::ProgramDesc> ConesMode::programDescs() {
    std::vector<gl::ProgramDesc> descs = {occlusionDesc()};
    for (const bool direct : {false, true})
        for (const bool diffuse : {false, true})
            for (const bool specular : {false, true})
                descs.push_back(composeDesc({direct, diffuse, specular}));
    return descs;
}

}  // namespace conelight::modes
