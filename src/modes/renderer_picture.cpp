// SPDX-License-Identifier: MIT
// A picture, in steps: scene, lights and surfaces are values that every mode starts from; the mode's recipe
// (modes/*_mode.cpp) makes the image of them.
#include <algorithm>
#include <optional>
#include <utility>

#include "base/clock.h"
#include "base/log.h"
#include "conelight/memory.h"
#include "gl/buffer.h"
#include "gl/debug.h"
#include "gl/dispatch_counter.h"
#include "gl/gl.h"
#include "gl/storage.h"
#include "image/background.h"
#include "image/debug_view.h"
#include "modes/modes.h"
#include "modes/renderer_values.h"
#include "modes/shader_variants.h"
#include "shared/lookups.h"

namespace conelight {
namespace {

// Pieces of one pass, of a picture in parts, are one.
void addPass(std::vector<PassStats>& passes, const gl::PassTime& time, bool merges) {
    const auto same = std::find_if(passes.begin(), passes.end(),
                                   [&](const PassStats& pass) { return merges && pass.name == time.name; });
    if (same == passes.end())
        return passes.push_back({time.name, time.cpuMs, time.wallMs, time.gpuMs}), void();
    same->cpuMs += time.cpuMs;
    same->wallMs += time.wallMs;
}

bool isOfLight(Component component) {
    return component == Component::Full || component == Component::Direct ||
           component == Component::Indirect || component == Component::Diffuse ||
           component == Component::Specular;
}

// Views of a still whose picture is out of focus, where it is not said how many.
constexpr int kLensViews = 64;
// Views that share the work of a picture that gathers over frames.
constexpr int kTemporalViews = 16;

bool isTemporal(const Settings& settings) {
    return settings.image.temporal == Toggle::On && isOfLight(settings.component);
}

// Means over frames follow what moves; those of mode traced may begin with a finished picture.
view::Surfaces::Motion motionOf(const Settings& settings) {
    using Motion = view::Surfaces::Motion;
    const bool traced = settings.mode == Mode::Traced;
    if (isTemporal(settings) || (traced && settings.traced.budgeted)) return Motion::Drawn;
    return traced ? Motion::Kept : Motion::None;
}

// Of which the picture is the mean; 0: it is that of the pixels' centres. Stills of light have them; what pixels
// are of is told at their centres.
int viewsOfStill(const Settings& settings, const Camera& camera) {
    const bool ofLight = isOfLight(settings.component);
    const bool moves = settings.mode == Mode::Traced && settings.traced.budgeted;
    if (!ofLight || moves || isTemporal(settings)) return 0;
    return settings.image.antialiasing > 0 ? settings.image.antialiasing : camera.hasLens() ? kLensViews : 0;
}

// By how many quarters area lights are turned for a view: neighbouring views share maps, and the last ones are unturned,
// as the next picture begins.
int quartersOf(int view, int count) { return (4 * view / count + 1) % 4; }

// Through points of the pixel, or their centres, and points of the lens.
view::PixelPart partOfStill(const Settings& settings, int index) {
    view::PixelPart part;
    if (settings.image.antialiasing > 0) part = view::pixelPart(index, settings.image.antialiasing);
    part.lens = view::lensPoint(index);
    return part;
}

}  // namespace

bool Renderer::Impl::goOn(double milliseconds) {
    const double cpuStart = base::processCpuMs(), wallStart = base::wallMs();
    pace.begin(milliseconds);
    device.pace = inParts ? &pace : nullptr;
    try {
        steps.step();
    } catch (...) {
        drop();
        left = true;
        throw;
    }
    device.pace = nullptr;
    cpuMs += base::processCpuMs() - cpuStart;
    wallMs += base::wallMs() - wallStart;
    if (!steps.done()) return false;
    steps = {};
    if (std::exchange(inParts, false)) std::swap(image, nextImage);
    if (!profiler.enabled()) return true;
    stats.cpuMs = cpuMs;
    stats.wallMs = wallMs;
    return true;
}

// What it has begun to write is whole before others read it.
void Renderer::Impl::drop() {
    device.pace = nullptr;
    if (!steps.done()) {
        gl::barrier(gl::Access::ShaderStorage | gl::Access::TextureFetch | gl::Access::ImageAccess |
                    gl::Access::Update | gl::Access::Framebuffer);
        left = true;
    }
    steps = {};
    inParts = false;
}

// With less where the whole does not fit into the memory there may be.
base::Steps Renderer::Impl::renderWithin(WantedPicture asked) {
    bool said = true;
    for (;;) {
        try {
            WantedPicture fitting = asked;
            fitting.settings = fit.fitted(asked.settings, asked.width, asked.height);
            co_await render(std::move(fitting));
            break;
        } catch (const gl::MemoryError&) {
            device.pace = nullptr;  // without a picture to show meanwhile
            forgetPicture();
            if (!fit.lower(asked.settings)) throw;
            said = false;
        }
    }
    if (!said)
        base::log(LogLevel::Warning,
                  base::format("memory: within %zu MB by ", memoryLimit() >> 20) + fit.text(asked.settings));
}

// All that was made of the scene. It may be half made.
void Renderer::Impl::forgetPicture() {
    mode.reset();
    lights = {};
    cascades = {};
    surfaces = {};
    reducedSurfaces = {};
    partSurfaces = {};
    image = {};
    nextImage = {};
    views = {};
    temporal.reset();
    display = {};
    turned = {};
    shadowMapView = {};
    wireframe = {};
    headlight = {};
}

base::Steps Renderer::Impl::render(WantedPicture asked) {
    const double cpuStart = base::processCpuMs();
    const double wallStart = base::wallMs();
    const Settings& settings = asked.settings;
    profiler.beginFrame();
    programs.trim();
    if (everyFrame) scene.require("render").touch();
    const std::uint64_t drawnBefore = scene->drawCalls(), waitedBefore = gl::waitCount();
    lookupCounters.clear();
    target().resize(asked.width, asked.height);
    std::optional<gl::DispatchCounter> dispatches;
    if (countDispatches && !inParts) dispatches.emplace();
    co_await drawPicture(asked);
    // Pictures of surfaces between those of light leave it as it is.
    if (temporal && settings.image.temporal != Toggle::On) {
        temporal.reset();
        partSurfaces = {};
    }
    gl::barrier(gl::Access::TextureFetch | gl::Access::Framebuffer | gl::Access::ImageAccess);
    if (settings.component != Component::ShadowMap) drawOverlays(settings);
    const std::uint64_t waits = gl::waitCount() - waitedBefore;  // times are waited for behind them
    collectStats();
    stats.drawCalls = scene->drawCalls() - drawnBefore;
    stats.waits = waits;
    if (dispatches)
        for (const gl::DispatchCount& one : dispatches->counts())
            stats.dispatches.push_back(
                {one.pass, modes::variantNameOf(one.program), one.dispatches, one.invocations});
    if (profiler.enabled()) {
        stats.cpuMs = base::processCpuMs() - cpuStart;
        stats.wallMs = base::wallMs() - wallStart;
    }
    shownAs = std::move(asked);
    left = false;
}

base::Steps Renderer::Impl::drawPicture(const WantedPicture& asked) {
    const Settings& settings = asked.settings;
    // Views of surfaces need neither lights nor a mode.
    const bool debugView = image::isDebugView(settings.component);
    if (!debugView || settings.view.voxels) {
        co_await prepare(settings);
        if (!isTemporal(settings)) co_await lights.turnInSteps(device, *scene, 0);
    }
    co_await gl::rest(device);
    const int count = viewsOfStill(settings, asked.camera);
    co_await prepareCascades(asked.camera, settings);
    co_await gl::rest(device);
    co_await seeCenters(asked);
    co_await gl::rest(device);
    const gl::Texture& output = target().texture();
    if (debugView)
        image::drawDebugView(device, *scene, surfaces, settings.component, output);
    else if (settings.component == Component::ShadowMap)
        shadowMapView.draw(device, scene->source(), lights, settings.view.light, output);
    else if (isTemporal(settings))
        co_await drawTemporal(asked.camera, settings);
    else {
        const modes::Frame centers = frame(settings);
        co_await drawLight(centers);
    }
    if (count > 0) co_await drawParts(asked.camera, settings, count);
}

base::Steps Renderer::Impl::seeCenters(const WantedPicture& asked) {
    const Settings& settings = asked.settings;
    const bool still = viewsOfStill(settings, asked.camera) > 0;
    const view::Surfaces::Picture picture{.camera = asked.camera,
                                          .width = asked.width,
                                          .height = asked.height,
                                          .cullBackFaces = true,
                                          .part = still ? view::centersOfStill() : view::PixelPart{},
                                          .withGlass = image::isDebugView(settings.component),
                                          .shrink = settings.view.shrink,
                                          .cascades = &cascades,
                                          .motion = motionOf(settings)};
    co_await surfaces.seeInSteps(device, *scene, picture);
    co_await seeReduced(picture, settings);
}

// With the same camera. Where the size is no multiple, its sides are a little less or more wide: a rim that it does not show
// takes what is nearest.
base::Steps Renderer::Impl::seeReduced(view::Surfaces::Picture picture, const Settings& settings) {
    const int reduction = settings.traced.reduction;
    if (settings.mode != Mode::Traced || reduction == 1 || !isOfLight(settings.component)) {
        if (reducedSurfaces) reducedSurfaces = {};
        co_return;
    }
    picture.width = (picture.width + reduction - 1) / reduction;
    picture.height = (picture.height + reduction - 1) / reduction;
    picture.cascades = nullptr;
    co_await gl::rest(device);
    co_await reducedSurfaces.seeInSteps(device, *scene, picture);
}

// By the mode, and the surroundings behind.
base::Steps Renderer::Impl::drawLight(const modes::Frame& frame) {
    co_await mode->drawInSteps(frame);
    co_await gl::rest(device);
    const Component component = frame.settings.component;
    if (component == Component::Full || component == Component::Direct) {
        co_await image::drawBackground(frame.device, frame.scene, frame.lights, frame.surfaces, frame.output);
        const image::Headlight::Inputs lit{frame.scene, frame.surfaces, headlightIrradiance};
        co_await headlight.draw(frame.device, lit, frame.output);
    }
    if (!frame.lights.drawsGlass() || !isOfLight(component)) co_return;
    co_await gl::rest(device);
    co_await mode->drawGlass(frame);
    co_await gl::rest(device);
}

base::Steps Renderer::Impl::seePart(const Camera& camera, const Settings& settings, view::PixelPart part) {
    const view::Surfaces::Picture picture{.camera = camera,
                                          .width = target().width(),
                                          .height = target().height(),
                                          .cullBackFaces = true,
                                          .part = part,
                                          .shrink = settings.view.shrink,
                                          .cascades = &cascades};
    co_await partSurfaces.seeInSteps(device, *scene, picture);
}

// Views through points beside the pixels' centres; their mean takes the place of the centres' picture.
base::Steps Renderer::Impl::drawParts(const Camera& camera, const Settings& settings, int count) {
    const image::LinearImage& picture = target();
    for (int i = 0; i < count; ++i) {
        co_await lights.turnInSteps(device, *scene, quartersOf(i, count));
        co_await seePart(camera, settings, partOfStill(settings, i));
        const modes::Frame part{.device = device,
                                .scene = *scene,
                                .lights = lights,
                                .surfaces = partSurfaces,
                                .settings = settings,
                                .output = views.view(picture.width(), picture.height()),
                                .besideCenters = true,
                                .part = i,
                                .parts = count};
        co_await drawLight(part);
        co_await views.add(device, i, picture.texture());
    }
}

// One view, and the pictures before. The first picture is that of the pixels' centres.
base::Steps Renderer::Impl::drawTemporal(const Camera& camera, const Settings& settings) {
    const image::LinearImage& picture = target();
    if (!temporal) temporal.emplace();
    temporal->follow({*scene, camera, picture.width(), picture.height(), settings});
    const bool held = lightHeld && temporal->still();
    const int quarters = held ? quartersOf(temporal->frame() % kTemporalViews, kTemporalViews) : 0;
    co_await lights.turnInSteps(device, *scene, quarters);
    const modes::Frame centers = frame(settings);
    if (temporal->fresh())
        co_await drawLight(centers);
    else if (mode->gathersForCenters() && !held)
        co_await mode->drawInSteps(centers);
    const view::PixelPart part = temporal->part(held || mode->settled());
    if (temporal->fresh()) {
        gl::barrier(gl::Access::TextureFetch | gl::Access::Framebuffer | gl::Access::ImageAccess |
                    gl::Access::Update);
        temporal->takeCenters(picture.texture());
    } else {
        co_await seePart(camera, settings, part);
        const modes::Frame beside{.device = device,
                                  .scene = *scene,
                                  .lights = lights,
                                  .surfaces = partSurfaces,
                                  .settings = settings,
                                  .output = temporal->view(),
                                  .besideCenters = true,
                                  .part = temporal->frame(),
                                  .parts = kTemporalViews};
        co_await drawLight(beside);
    }
    co_await temporal->add(device, *scene, surfaces, picture.texture());
}

// The mode, and the lights as it needs them.
base::Steps Renderer::Impl::prepare(const Settings& settings) {
    if (!mode || modeKind != settings.mode) {
        mode.reset();  // frees the old volumes first
        mode = modes::makeModeRenderer(settings.mode);
        modeKind = settings.mode;
    }
    const bool shadows =
        settings.component == Component::ShadowMap || mode->needsShadows(scene->source(), settings);
    const bool emitters = settings.light.emissiveQuads && mode->lightsFromEmitters(settings);
    const light::LightsWanted wanted{
        .settings = settings.light,
        .emissiveQuads = emitters,
        .smallLamps = settings.light.smallLamps && mode->lightsFromSmallLamps(),
        .shadowMaps = shadows,
        .caustics = mode->castsCaustics(),
        .veils = mode->seesVeils(),
        .lampTree = mode->drawsLamps() && settings.component != Component::ShadowMap};
    co_await lights.updateInSteps(device, *scene, wanted);
}

// Where pixels are lit straight by lights.
base::Steps Renderer::Impl::prepareCascades(const Camera& camera, const Settings& settings) {
    const bool direct = settings.component == Component::Full || settings.component == Component::Direct;
    if (direct && mode->readsCascades() && mode->needsShadows(scene->source(), settings))
        // Parallel rays see as finely far from the eye: what they look at is in the middle.
        co_await cascades.updateInSteps(device, *scene, lights, settings.light,
                                        camera.isOrthographic() ? camera.target : camera.eye);
    else if (cascades.levels() > 0)
        cascades.clear();
}

modes::Frame Renderer::Impl::frame(const Settings& settings) {
    return {.device = device,
            .scene = *scene,
            .lights = lights,
            .surfaces = surfaces,
            .reduced = reducedSurfaces ? &reducedSurfaces : nullptr,
            .settings = settings,
            .output = target().texture(),
            .lookupCounters = countLookups ? &lookupCounters : nullptr};
}

// Voxels among the objects, edges of triangles.
void Renderer::Impl::drawOverlays(const Settings& settings) {
    if (settings.view.voxels && settings.component != Component::Voxels && settings.mode != Mode::Phong) {
        Settings voxels = settings;
        voxels.component = Component::Voxels;
        modes::Frame among = frame(voxels);
        among.voxelsAmong = true;
        mode->draw(among);
        gl::barrier(gl::Access::TextureFetch | gl::Access::Framebuffer);
    }
    if (settings.view.wireframe != Wireframe::Off)
        wireframe.draw(device, *scene, surfaces, {settings.view.wireframe, settings.image.exposure, true},
                       target().texture());
}

void Renderer::Impl::collectStats() {
    stats = FrameStats{};
    stats.device = deviceName;
    if (!profiler.enabled()) return;
    if (gl::isSoftwareDriver()) gl::finish();
    for (const gl::PassTime& pass : profiler.endFrame()) addPass(stats.passes, pass, inParts);
    if (!countLookups) return;
    const std::vector<std::uint32_t> counts = lookupCounters.read<std::uint32_t>(LOOKUPS_WORDS);
    const double pixels = static_cast<double>(target().width()) * static_cast<double>(target().height());
    const char* const kinds[3] = {"diffuse", "specular", "occlusion"};
    for (std::size_t i = 0; i < 3; ++i)
        stats.lookupsPerPixel.emplace_back(kinds[i],
                                           (counts[i] + 4294967296.0 * counts[LOOKUPS_CARRY + i]) / pixels);
}

// The mode's passes once more, for one pixel, on the surfaces of the last picture.
PixelInspection Renderer::Impl::inspect(int x, int y) {
    prepare(shownAs.settings).finish();
    lights.turnInSteps(device, *scene, 0).finish();
    if (std::exchange(left, false)) {
        prepareCascades(shownAs.camera, shownAs.settings).finish();
        seeCenters(shownAs).finish();
    }
    gather::StepRecorder recorder({x, image.height() - 1 - y});
    modes::Frame recorded = frame(shownAs.settings);
    recorded.recorder = &recorder;
    recorded.lookupCounters = nullptr;
    mode->draw(recorded);
    PixelInspection found = recorder.read();
    found.x = x;
    found.y = y;
    found.mode = shownAs.settings.mode;
    found.picture = image.readPixel(x, y);
    return found;
}

}  // namespace conelight
