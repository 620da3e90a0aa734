// SPDX-License-Identifier: MIT
#include "modes/traced_mode.h"

#include <algorithm>
#include <optional>

#include "gather/pixel_rays.h"
#include "gather/traced_shade.h"
#include "gather/voxel_view.h"
#include "gl/gl.h"
#include "light/inject_light.h"
#include "light/irradiance_cache.h"
#include "shared/bindings.h"
#include "shared/irradiance.h"

namespace conelight::modes {
namespace {

// With a limited number of bounces updates are not averaged, so each has to do.
constexpr int kRaysPerBounce = 32;
// The first updates after a change only carry bounces around: what they find is replaced, so a quarter of the
// rays will do.
constexpr int kCoarseUpdates = IRRADIANCE_SETTLE;
// Means over frames while the cache is still on its way, so many updates: longer ones would show old light
// (builtin:cornell-point, interactive: 16 frames to settle instead of 12 when they were long after 8
// updates).
constexpr int kUnsettledMean = 4;
constexpr int kUnsettledUpdates = 14;
constexpr int kOcclusionPasses = 16;
constexpr int kOcclusionRays = 2;

bool sameView(const gpu::FrameConstants& a, const gpu::FrameConstants& b) {
    return a.clipFromWorld == b.clipFromWorld && a.eye == b.eye && a.viewForward == b.viewForward &&
           a.viewRight == b.viewRight && a.viewUp == b.viewUp && a.width == b.width && a.height == b.height;
}

// Whether any surface may be as smooth as `limit`.
bool hasGloss(const scene::GpuScene& scene, float limit) {
    return std::any_of(
        scene.instances().begin(), scene.instances().end(),
        [&](const gpu::Instance& instance) { return gather::mayHaveLobe(scene, instance, limit); });
}

}  // namespace

struct TracedMode::Impl {
    voxels::SurfaceVoxels surface;
    voxels::OctantWords octants;
    light::EmissionFit emissionFit;
    light::IrradianceCache cache;
    gather::PixelRays diffuse{gather::RayPicture::Diffuse};
    gather::PixelRays specular{gather::RayPicture::Specular};
    gather::PixelRays occlusion{gather::RayPicture::Occlusion};
    gather::TracedShade shade;
    gather::VoxelView voxelView;

    // What the light was gathered for, and what has changed since.
    bool geometryDirty = true;
    bool lightDirty = true;
    VoxelSettings voxelsFor;  // of the last picture
    std::optional<TracedSettings> gatheredFor;
    glm::vec3 sky{-1};

    // The pictures so far: from where, how many passes, where instances were.
    struct Seen {
        std::optional<gpu::FrameConstants> view;
        int passes = 0;
    };
    Seen seenDiffuse, seenSpecular, seenOcclusion;
    std::vector<glm::mat4> placed;
    gl::Buffer motion;
    bool moved = false;

    void updateVoxels(const FrameContext& frame);
    void updateCache(const FrameContext& frame);
    void followInstances(const FrameContext& frame);
    void gather(const FrameContext& frame, gather::PixelRays& picture, Seen& seen, int rays, int passes);
    gather::PixelRayFrame rayFrame(const FrameContext& frame) const;
    int updatesWanted(const TracedSettings& settings) const;
    bool sameUpdates(const TracedSettings& a, const TracedSettings& b) const;
    void drawParts(const FrameContext& frame, const gather::PictureParts& parts);
};

// Voxels, what rays need to cross them, and direct light on their faces.
void TracedMode::Impl::updateVoxels(const FrameContext& frame) {
    const TracedSettings& settings = frame.settings.traced;
    const bool otherUpdates = gatheredFor && !sameUpdates(*gatheredFor, settings);
    const bool otherBounces = gatheredFor && gatheredFor->bounces != settings.bounces;
    // Else a picture would be better or worse for the settings of those before it. Moving ones keep what is
    // there.
    const bool otherGrid = gatheredFor && !(voxelsFor == frame.settings.voxels);
    const bool anew = otherBounces || ((otherUpdates || otherGrid) && !settings.budgeted);
    voxelsFor = frame.settings.voxels;
    geometryDirty = geometryDirty || anew;
    // Light of a limited number of bounces starts in the dark.
    const bool limited = settings.bounces.has_value();
    if (limited && lightDirty) geometryDirty = true;
    if (geometryDirty) {
        if (limited || anew) cache.reset();
        cache.beforeVoxelize(frame.profiler, surface);
        if (frame.everythingAnew)
            surface.build(frame.programs, frame.profiler, frame.scene, frame.settings.voxels);
        else
            surface.update(frame.programs, frame.profiler, frame.scene, frame.settings.voxels);
        octants.build(frame.programs, frame.profiler, surface);
        emissionFit.known = false;
        voxelView.voxelsChanged();
        cache.afterVoxelize(frame.programs, frame.profiler, surface);
    }
    if (geometryDirty || lightDirty) {
        octants.bind();
        light::injectLight(frame.programs, frame.profiler, frame.scene, frame.settings.light, surface,
                           &surface.secondFaceScratch(), &emissionFit);
        voxelView.lightChanged();
        cache.lightChanged();
    } else if (otherUpdates) {
        cache.lightChanged();
    }
    if (geometryDirty || lightDirty || !gatheredFor || !(*gatheredFor == settings))
        seenDiffuse.passes = seenSpecular.passes = seenOcclusion.passes = 0;
    gatheredFor = settings;
    geometryDirty = lightDirty = false;
}

// Whether both settings update the cache in the same way.
bool TracedMode::Impl::sameUpdates(const TracedSettings& a, const TracedSettings& b) const {
    return updatesWanted(a) == updatesWanted(b) && a.cacheRays == b.cacheRays && a.bounces == b.bounces &&
           a.exactHits == b.exactHits;
}

// Rays at pixels add a bounce to what the cache holds.
int TracedMode::Impl::updatesWanted(const TracedSettings& settings) const {
    if (!settings.bounces) return settings.cacheUpdates;
    return *settings.bounces - (settings.pixelRays > 0 ? 1 : 0);
}

void TracedMode::Impl::updateCache(const FrameContext& frame) {
    const TracedSettings& settings = frame.settings.traced;
    const bool limited = settings.bounces.has_value();
    light::CacheSettings cacheSettings;
    // A reflection is a bounce, which updates count.
    if (limited) cacheSettings.reflections = 0;
    cacheSettings.averages = !limited;
    cacheSettings.exactDirect = settings.exactHits;
    cacheSettings.facesPerUpdate = settings.budgeted ? static_cast<std::uint32_t>(settings.faceBudget) : 0;
    const auto run = [&](int rays, int passes) {
        if (passes > 0) voxelView.lightChanged();
        cacheSettings.cosineRays = cacheSettings.lightRays = rays;
        cache.update(frame.programs, frame.profiler, frame.scene, frame.settings.light, surface,
                     cacheSettings, passes);
    };
    octants.bind();
    const int wanted = updatesWanted(settings);
    const int missing = std::max(wanted - cache.updates(), 0);
    if (limited) {
        run(std::max(settings.cacheRays, kRaysPerBounce), missing);
    } else if (settings.budgeted) {
        run(settings.cacheRays, std::min(missing, 1));
    } else {
        const int coarse = std::clamp(kCoarseUpdates - cache.updates(), 0, missing);
        run(std::max(settings.cacheRays / 4, 1), coarse);
        run(settings.cacheRays, missing - coarse);
    }
    surface.bind();
    cache.bind();
}

// Where each instance was in the frame before, for means that follow them.
void TracedMode::Impl::followInstances(const FrameContext& frame) {
    const std::vector<gpu::Instance>& instances = frame.scene.instances();
    const bool known = placed.size() == instances.size();
    if (!known) seenDiffuse = seenSpecular = seenOcclusion = {};
    moved = false;
    std::vector<glm::mat4> now, oldFromWorld;
    for (std::size_t i = 0; i < instances.size(); ++i) {
        now.push_back(instances[i].worldFromObject);
        if (!known) continue;
        const bool still = placed[i] == now[i];
        oldFromWorld.push_back(still ? glm::mat4(1) : placed[i] * glm::inverse(now[i]));
        moved = moved || !still;
    }
    if (moved) motion = gl::Buffer(oldFromWorld, "instance motion");
    placed = std::move(now);
}

gather::PixelRayFrame TracedMode::Impl::rayFrame(const FrameContext& frame) const {
    const glm::ivec3 size = surface.grid().size;
    return {frame.programs,
            frame.profiler,
            frame.scene,
            frame.settings.light,
            frame.view,
            surface.grid().voxelSize,
            static_cast<float>(std::max({size.x, size.y, size.z})),
            moved ? &motion : nullptr,
            frame.lookupCounters};
}

// Finished at once, or one more pass on top of what is known from before.
void TracedMode::Impl::gather(const FrameContext& frame, gather::PixelRays& picture, Seen& seen, int rays,
                              int passes) {
    const TracedSettings& settings = frame.settings.traced;
    const gather::PixelRayFrame rayFrame = this->rayFrame(frame);
    const bool known = seen.view && picture.has(frame.width, frame.height);
    const bool still = known && sameView(*seen.view, frame.view) && !moved;
    if (settings.budgeted) {
        const bool settled = cache.updates() >= std::min(updatesWanted(settings), kUnsettledUpdates);
        const auto reuse =
            !known ? gather::Reuse::None : (still ? gather::Reuse::SameView : gather::Reuse::Reproject);
        picture.gather(rayFrame, settings, reuse, rays, static_cast<std::uint32_t>(seen.passes),
                       settled ? passes : std::min(passes, kUnsettledMean));
        ++seen.passes;
    } else {
        if (!still) seen.passes = 0;
        for (; seen.passes < passes; ++seen.passes)
            picture.gather(rayFrame, settings,
                           seen.passes == 0 ? gather::Reuse::None : gather::Reuse::SameView, rays,
                           static_cast<std::uint32_t>(seen.passes), passes);
    }
    seen.view = frame.view;
}

void TracedMode::Impl::drawParts(const FrameContext& frame, const gather::PictureParts& parts) {
    const TracedSettings& settings = frame.settings.traced;
    const bool gathers = settings.bounces != 0;
    const gather::PictureParts shown{parts.direct, parts.diffuse && gathers, parts.specular && gathers};
    const gl::Texture* irradiance = nullptr;
    const gl::Texture* lobe = nullptr;
    gather::PixelRectangle lobes;
    if (settings.pixelRays > 0 && (shown.diffuse || shown.specular)) {
        gather(frame, diffuse, seenDiffuse, settings.pixelRays, settings.passes);
        irradiance = &diffuse.filtered(rayFrame(frame), settings.filterLevels);
    }
    if (settings.specularRays > 0 && shown.specular && hasGloss(frame.scene, settings.specularLimit)) {
        if (settings.exactMirrors) surface.bindTriangles();
        gather(frame, specular, seenSpecular, settings.specularRays, settings.passes);
        lobe = &specular.filtered(rayFrame(frame), settings.filterLevels);
        lobes = specular.lobes();
    }
    shade.draw(frame.programs, frame.profiler, frame.scene, frame.settings, shown, irradiance, lobe, lobes,
               frame.gbuffer, frame.view.sky, frame.output, frame.lookupCounters);
}

TracedMode::TracedMode() : impl_(std::make_unique<Impl>()) {}
TracedMode::~TracedMode() = default;

// Every component has lit voxels or direct light in it, or leaves them behind for the next.
bool TracedMode::needsShadows(const Settings&) const { return true; }

void TracedMode::render(const FrameContext& frame) {
    Impl& m = *impl_;
    m.geometryDirty = m.geometryDirty || frame.geometryChanged;
    m.lightDirty = m.lightDirty || frame.lightChanged;
    const Component component = frame.settings.component;
    const gather::PictureParts parts = gather::partsOf(component);
    const bool usesVoxels = component == Component::Occlusion || component == Component::Voxels ||
                            ((parts.diffuse || parts.specular) && frame.settings.traced.bounces != 0);
    if (usesVoxels) {
        m.updateVoxels(frame);
        m.updateCache(frame);
        m.followInstances(frame);
    }
    frame.gbuffer.bind(UNIT_GBUFFER);
    switch (component) {
        case Component::Occlusion:
            m.gather(frame, m.occlusion, m.seenOcclusion, kOcclusionRays, kOcclusionPasses);
            m.shade.drawOcclusion(frame.programs, frame.profiler, m.occlusion.filtered(m.rayFrame(frame), 1),
                                  frame.output);
            break;
        case Component::Voxels:
            m.voxelView.draw(
                {frame.programs, frame.profiler, frame.settings, frame.view, frame.output, frame.voxelsAmong},
                m.surface, true);
            break;
        default:
            m.drawParts(frame, parts);
    }
}

void TracedMode::record(const FrameContext& frame, gather::StepRecorder& recorder) {
    Impl& m = *impl_;
    const TracedSettings& settings = frame.settings.traced;
    m.geometryDirty = m.geometryDirty || frame.geometryChanged;
    m.lightDirty = m.lightDirty || frame.lightChanged;
    if (m.geometryDirty || m.lightDirty || !m.gatheredFor || !(*m.gatheredFor == settings)) {
        m.updateVoxels(frame);
        m.updateCache(frame);
    } else {
        m.octants.bind();
        m.surface.bind();
        m.cache.bind();
    }
    frame.gbuffer.bind(UNIT_GBUFFER);
    const gather::PixelRayFrame rays = m.rayFrame(frame);
    if (frame.settings.component == Component::Occlusion)
        return m.occlusion.record(rays, settings, kOcclusionRays, kOcclusionPasses, recorder);
    if (settings.bounces == 0) return;
    if (settings.pixelRays > 0)
        m.diffuse.record(rays, settings, settings.pixelRays, settings.passes, recorder);
    else
        m.shade.recordCache(frame.programs, recorder);
    if (settings.specularRays > 0 && hasGloss(frame.scene, settings.specularLimit)) {
        if (settings.exactMirrors) m.surface.bindTriangles();
        m.specular.record(rays, settings, settings.specularRays, settings.passes, recorder);
    }
}

std::vector<gl::ProgramDesc> TracedMode::programDescs() {
    std::vector<gl::ProgramDesc> descs = gather::PixelRays::programDescs();
    const std::vector<gl::ProgramDesc> shade = gather::TracedShade::programDescs();
    descs.insert(descs.end(), shade.begin(), shade.end());
    return descs;
}

}  // namespace conelight::modes
