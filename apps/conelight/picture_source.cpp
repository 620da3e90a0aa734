// SPDX-License-Identifier: MIT
#include "picture_source.h"

#include <fmt/core.h>

#include <algorithm>

#include "conelight/error.h"
#include "memory_limit.h"
#include "platform/context_health.h"
#include "scene_upload.h"
#include "session/session.h"
#include "static_light.h"
#include "traced_picture.h"

namespace conelight::program {
namespace {

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const std::size_t n = values.size();
    return n % 2 == 1 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
}

void show(Progress* progress, const std::string& text) {
    if (progress != nullptr) progress->show(text);
}

struct Bake {
    std::string key;  // the settings it was made with
    Scene scene;
    reference::RadiosityStats stats;
};

std::string keyOf(const reference::RadiositySettings& s) {
    return fmt::format("{} {} {} {} {} {} {} {} {}", s.patchSize, s.maxSubdivision, s.subdivideError,
                       s.residual, s.patchRays, s.gatherRays, s.visibilityRays, s.bounces, s.seed);
}

reference::BeamSettings beamSettings(const PictureRequest& request) {
    reference::BeamSettings settings;
    settings.bounces = request.reference.bounces;
    settings.filter = request.reference.filter;
    settings.emissiveQuads = request.settings.light.emissiveQuads;
    settings.lampPoints = request.lampPoints;
    return settings;
}

// image += sign * other, rgb only.
void add(Image& image, const Image& other, float sign) {
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        image.pixels[i] += sign * glm::vec4(glm::vec3(other.pixels[i]), 0);
}

}  // namespace

bool isRendererMode(const std::string& name) {
    const std::vector<std::string> names = settingChoices("mode");
    return std::find(names.begin(), names.end(), name) != names.end();
}

bool isModeName(const std::string& name) {
    const std::vector<std::string> names = sessionModes();
    return std::find(names.begin(), names.end(), name) != names.end();
}

std::string modeNames() {
    const std::vector<std::string> names = sessionModes();
    std::string all = names.front();
    for (std::size_t i = 1; i < names.size(); ++i) all += (i + 1 < names.size() ? ", " : " or ") + names[i];
    return all;
}

void requireModeName(const std::string& name) {
    if (isModeName(name)) return;
    throw Error(ErrorKind::Usage, "there is no mode '" + name + "'; " + modeNames() + " would be right");
}

Component componentOf(const std::string& name) {
    Settings settings;
    setSetting(settings, "component", name);
    return settings.component;
}

struct PictureSource::Impl {
    ViewOptions view;
    std::string shaderDirectory;
    std::unique_ptr<platform::HeadlessContext> context;
    std::unique_ptr<Renderer> renderer;
    const Scene* scene = nullptr;
    const Scene* uploaded = nullptr;   // what the renderer holds
    const Session* session = nullptr;  // null: of setScene
    std::uint64_t sessionTables = 0;   // of the session when tracer and bakes were made
    SceneUpload changes;
    std::optional<reference::PathTracer> tracer;
    std::optional<Bake> lit, direct;  // by all light asked for; by light that comes straight from lights
    StaticBake statics;               // of mode hybrid

    void dropTruths();
    void upload(const Scene& wanted, Progress* progress);
    Image drawGl(const PictureRequest& request, const Settings& settings, Picture& picture);
    FrameCost costOf(const PictureRequest& request, const Settings& settings);
    reference::PathTracedPicture trace(const PictureRequest& request, Picture& picture, Progress* progress);
    const Bake& bake(std::optional<Bake>& kept, const reference::RadiositySettings& settings,
                     Picture& picture, Progress* progress);

    void drawRenderer(const PictureRequest& request, Picture& picture, Progress* progress);
    void drawTraced(const PictureRequest& request, Picture& picture, Progress* progress);
    void drawRadiosity(const PictureRequest& request, Picture& picture, Progress* progress);
    void drawBeams(const PictureRequest& request, Picture& picture, Progress* progress) const;
};

PictureSource::PictureSource(const ViewOptions& view, const std::string& shaderDirectory)
    : impl_(std::make_unique<Impl>()) {
    impl_->view = view;
    impl_->shaderDirectory = shaderDirectory;
}

PictureSource::~PictureSource() = default;

void PictureSource::setScene(const Scene& scene) {
    impl_->scene = &scene;
    impl_->session = nullptr;
    impl_->uploaded = nullptr;
    impl_->dropTruths();
}

void PictureSource::changeScene(const Scene& scene) {
    const Scene* const shown = impl_->uploaded;
    setScene(scene);
    if (shown == nullptr) return;
    Renderer& renderer = *impl_->renderer;
    for (std::size_t i = 0; i < scene.meshes.size(); ++i)
        if (scene.meshes[i].positions != shown->meshes[i].positions) renderer.setMesh(i, scene.meshes[i]);
    for (std::size_t i = 0; i < scene.materials.size(); ++i)
        if (scene.materials[i] != shown->materials[i]) renderer.setMaterial(i, scene.materials[i]);
    for (std::size_t i = 0; i < scene.instances.size(); ++i)
        if (!(scene.instances[i] == shown->instances[i])) renderer.setInstance(i, scene.instances[i]);
    if (scene.lights != shown->lights) renderer.setLights(scene.lights);
    if (!(scene.environment == shown->environment)) renderer.setEnvironment(scene.environment);
    impl_->uploaded = &scene;
}

void PictureSource::follow(const Session& session) {
    const std::uint64_t tables = session.revisions().sceneTables();
    const bool other = impl_->session != &session;
    if (!other && impl_->sessionTables == tables) return;
    if (other || impl_->uploaded != &session.scene()) impl_->uploaded = nullptr;  // it may hold a bake
    impl_->dropTruths();
    impl_->scene = &session.scene();
    impl_->session = &session;
    impl_->sessionTables = tables;
}

// What rays and radiosity know of the scene.
void PictureSource::Impl::dropTruths() {
    tracer.reset();
    lit.reset();
    direct.reset();
}

std::string PictureSource::device() const { return impl_->context ? impl_->context->description() : ""; }

// Makes the context and the renderer at the first call; `wanted` is in the renderer afterwards.
void PictureSource::Impl::upload(const Scene& wanted, Progress* progress) {
    if (!renderer) {
        show(progress, "starting OpenGL");
        context = openContext(view);
        renderer = std::make_unique<Renderer>(rendererOptions(view, shaderDirectory));
    }
    const bool follows = session != nullptr && &wanted == scene;
    if (uploaded == &wanted && !follows) return;
    show(progress, "uploading the scene");
    if (follows) {
        if (uploaded != &wanted) changes.forget();
        changes.follow(*renderer, *session);
    } else {
        renderer->setScene(wanted);
    }
    uploaded = &wanted;
}

// One component. The first of a picture is drawn until it has settled, and is the one that is measured.
Image PictureSource::Impl::drawGl(const PictureRequest& request, const Settings& settings, Picture& picture) {
    const bool first = picture.images.empty();
    renderer->setProfiling(first && request.profile, first && request.profile);
    for (int frame = 0; frame < (first ? request.frames : 1); ++frame)
        renderer->render(request.camera, request.size.width, request.size.height, settings);
    Image image = renderer->readImage();
    platform::requireHealthyContext();
    if (!first) return image;
    picture.stats = renderer->stats();
    if (request.timedFrames > 0) picture.cost = costOf(request, settings);
    return image;
}

// A settled frame: times without counters, which slow it down; then lookups.
FrameCost PictureSource::Impl::costOf(const PictureRequest& request, const Settings& settings) {
    std::vector<double> cpu, wall, gpu;
    renderer->setProfiling(true, false);
    for (int frame = 0; frame < request.timedFrames; ++frame) {
        renderer->render(request.camera, request.size.width, request.size.height, settings);
        const FrameStats& stats = renderer->stats();
        cpu.push_back(stats.cpuMs);
        wall.push_back(stats.wallMs);
        double sum = 0;
        for (const PassStats& pass : stats.passes) sum += pass.gpuMs;
        gpu.push_back(sum);
    }
    renderer->setProfiling(true, true);
    renderer->render(request.camera, request.size.width, request.size.height, settings);
    const FrameStats& stats = renderer->stats();
    FrameCost cost;
    cost.cpuMs = median(cpu);
    cost.wallMs = median(wall);
    if (!stats.passes.empty() && stats.passes.front().gpuMs >= 0) cost.gpuMs = median(gpu);
    cost.lookupsPerPixel = stats.lookupsPerPixel;
    for (const MemoryStats& object : stats.memory) cost.memoryBytes += object.bytes;
    return cost;
}

void PictureSource::Impl::drawRenderer(const PictureRequest& request, Picture& picture, Progress* progress) {
    Settings settings = request.settings;
    setSetting(settings, "mode", request.mode);
    std::shared_ptr<const BakedLight> baked;
    if (settings.mode == Mode::Hybrid) {
        reference::RadiositySettings bake = request.radiosity;
        bake.emissiveQuads = settings.light.emissiveQuads;
        const std::size_t before = statics.bakes();
        baked = staticLight(statics, *scene, bake, progress);
        if (statics.bakes() > before) picture.baked = statics.stats();
        picture.stopped = interrupted();
    }
    upload(*scene, progress);
    renderer->setBakedLight(baked);
    if (settings.mode == Mode::Traced && settings.image.antialiasing == 0)
        settings.image.antialiasing = request.tracedViews;
    for (const Component component : request.components) {
        settings.component = component;
        show(progress, "rendering " + getSetting(settings, "component"));
        picture.images.push_back(drawGl(request, settings, picture));
    }
}

reference::PathTracedPicture PictureSource::Impl::trace(const PictureRequest& request, Picture& picture,
                                                        Progress* progress) {
    const HostMemoryLimit limit;
    if (!tracer) {
        show(progress, "building the ray structure");
        tracer.emplace(*scene);
    }
    reference::PathTracerSettings settings = request.reference;
    settings.emissiveQuads = request.settings.light.emissiveQuads;
    settings.smallLamps = request.settings.light.smallLamps;
    settings.features = request.denoiser != reference::Denoiser::None;
    reference::PathTracedPicture traced =
        program::trace(*tracer, request.camera, request.size, settings, progress);
    picture.stopped = interrupted();
    if (!settings.features || traced.samplesPerPixel == 0) return traced;
    show(progress, "taking out noise");
    return reference::denoise(traced, {request.denoiser, 0});
}

void PictureSource::Impl::drawTraced(const PictureRequest& request, Picture& picture, Progress* progress) {
    const reference::PathTracedPicture none;
    for (const Component component : request.components) imageOf(none, component);  // refused before the work
    picture.traced = trace(request, picture, progress);
    for (const Component component : request.components)
        picture.images.push_back(imageOf(*picture.traced, component));
    picture.cost.cpuMs = 1e3 * picture.traced->cpuSeconds;
    picture.cost.wallMs = 1e3 * picture.traced->wallSeconds;
}

const Bake& PictureSource::Impl::bake(std::optional<Bake>& kept, const reference::RadiositySettings& settings,
                                      Picture& picture, Progress* progress) {
    if (kept && kept->key == keyOf(settings)) return *kept;
    show(progress, "radiosity");
    const StoppableScope stoppable;
    const HostMemoryLimit limit;
    const auto onProgress = [&](const reference::RadiosityProgress& now) {
        std::string text = fmt::format("radiosity: {:.0f} %", 100 * now.done);
        if (now.secondsLeft >= 0) text += ", " + timeText(now.secondsLeft) + " left";
        show(progress, text);
        return !interrupted();
    };
    uploaded = nullptr;  // the renderer may hold the bake that is replaced
    kept.emplace();
    kept->key = keyOf(settings);
    kept->scene = reference::bakeRadiosity(*scene, settings, &kept->stats, onProgress);
    picture.stopped = interrupted();
    return *kept;
}

// The baked scene carries its light in unlit materials, so any mode of the renderer shows it; phong is the
// cheapest. Indirect light is what a bake by light straight from lights lacks.
void PictureSource::Impl::drawRadiosity(const PictureRequest& request, Picture& picture, Progress* progress) {
    const auto wants = [&](Component which) {
        return std::find(request.components.begin(), request.components.end(), which) !=
               request.components.end();
    };
    if (wants(Component::Occlusion) || wants(Component::Voxels))
        throw Error(ErrorKind::Usage,
                    "mode radiosity: it has no voxels and no occlusion; full, direct, indirect, diffuse or "
                    "specular would be right");
    Settings settings = request.settings;
    settings.mode = Mode::Phong;
    settings.component = Component::Full;
    const Bake& whole = bake(lit, request.radiosity, picture, progress);
    picture.baked = whole.stats;
    upload(whole.scene, progress);
    const Image all = drawGl(request, settings, picture);
    renderer->setProfiling(false, false);
    const auto drawOf = [&](const Scene& drawn, Component component) {
        upload(drawn, progress);
        settings.component = component;
        renderer->render(request.camera, request.size.width, request.size.height, settings);
        return renderer->readImage();
    };
    Image straight, reflections = all;
    if (wants(Component::Direct) || wants(Component::Indirect) || wants(Component::Diffuse)) {
        reference::RadiositySettings once = request.radiosity;
        once.bounces = 0;
        straight = drawOf(bake(direct, once, picture, progress).scene, Component::Full);
    }
    add(reflections, all, -1);
    if (request.radiositySpecular) reflections = trace(request, picture, progress).specular;
    for (const Component component : request.components) {
        const bool indirect = component == Component::Indirect || component == Component::Diffuse;
        Image image = component == Component::Direct     ? straight
                      : component == Component::Specular ? reflections
                                                         : all;
        if (indirect) add(image, straight, -1);
        if (component == Component::Full || component == Component::Indirect) add(image, reflections, 1);
        const bool light = indirect || component == Component::Full || component == Component::Direct ||
                           component == Component::Specular;
        if (!light) image = drawOf(*scene, component);  // what the surfaces are, from the scene as it was
        picture.images.push_back(std::move(image));
    }
}

void PictureSource::Impl::drawBeams(const PictureRequest& request, Picture& picture,
                                    Progress* progress) const {
    const HostMemoryLimit limit;
    const reference::BeamPicture none;
    for (const Component component : request.components) imageOf(none, component);  // refused before the work
    const reference::BeamPicture drawn =
        traceBeams(*scene, request.camera, request.size, beamSettings(request), progress);
    for (const Component component : request.components) picture.images.push_back(imageOf(drawn, component));
    picture.beams = drawn.stats;
    picture.cost.cpuMs = 1e3 * drawn.stats.cpuSeconds;
    picture.cost.wallMs = 1e3 * drawn.stats.wallSeconds;
    picture.stopped = drawn.stopped;
}

const Scene& PictureSource::bakedScene(const reference::RadiositySettings& settings, Progress* progress) {
    Picture ignored;
    return impl_->bake(impl_->lit, settings, ignored, progress).scene;
}

PixelInspection PictureSource::inspect(const PictureRequest& drawn, int x, int y) {
    if (!isRendererMode(drawn.mode) || !impl_->renderer)
        throw Error(ErrorKind::Usage, "inspect: mode " + drawn.mode +
                                          " keeps no cones or rays; traced, cones or thesis would be right");
    return impl_->renderer->inspectPixel(x, y);
}

Picture PictureSource::draw(const PictureRequest& request, Progress* progress) {
    requireModeName(request.mode);
    if (impl_->scene == nullptr)
        throw Error(ErrorKind::Usage,
                    "PictureSource: there is no scene; setScene before draw would be right");
    Picture picture;
    if (request.mode == "reference")
        impl_->drawTraced(request, picture, progress);
    else if (request.mode == "radiosity")
        impl_->drawRadiosity(request, picture, progress);
    else if (request.mode == "beams")
        impl_->drawBeams(request, picture, progress);
    else
        impl_->drawRenderer(request, picture, progress);
    return picture;
}

}  // namespace conelight::program
