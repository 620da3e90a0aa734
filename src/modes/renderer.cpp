// SPDX-License-Identifier: MIT
// The public face of the library: scene, lights and surfaces are values that every mode starts from; the
// mode's recipe (modes/*_mode.cpp) makes the image of them.
#include "conelight/renderer.h"

#include <algorithm>
#include <utility>

#include "base/clock.h"
#include "base/log.h"
#include "conelight/memory.h"
#include "gl/copy.h"
#include "gl/debug.h"
#include "gl/gl.h"
#include "gl/host_state.h"
#include "gl/storage.h"
#include "image/background.h"
#include "image/debug_view.h"
#include "image/display.h"
#include "image/image.h"
#include "image/shadow_view.h"
#include "image/temporal_picture.h"
#include "image/view_mean.h"
#include "image/wireframe.h"
#include "light/lights.h"
#include "modes/execution.h"
#include "modes/memory_fit.h"
#include "modes/modes.h"
#include "scene/held_scene.h"
#include "shared/lookups.h"
#include "view/surfaces.h"

namespace conelight {
namespace {

std::vector<MemoryStats> memoryStats() {
    std::vector<MemoryStats> memory;
    for (const gl::LiveObject& object : gl::liveObjects())
        if (object.bytes > 0) memory.push_back({object.label, object.bytes});
    std::stable_sort(memory.begin(), memory.end(),
                     [](const auto& a, const auto& b) { return a.bytes > b.bytes; });
    return memory;
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

// Of which the picture is the mean; 0: it is that of the pixels' centres. Stills of light have them; what pixels
// are of is told at their centres.
int viewsOfStill(const Settings& settings, const Camera& camera) {
    const bool ofLight = isOfLight(settings.component);
    const bool moves = settings.mode == Mode::Traced && settings.traced.budgeted;
    if (!ofLight || moves || isTemporal(settings)) return 0;
    const bool hasLens = camera.lensDiameter > 0 && camera.focus() > 0;
    return settings.image.antialiasing > 0 ? settings.image.antialiasing : hasLens ? kLensViews : 0;
}

// Through points of the pixel, or their centres, and points of the lens.
view::PixelPart partOfStill(const Settings& settings, int index) {
    view::PixelPart part;
    if (settings.image.antialiasing > 0) part = view::pixelPart(index, settings.image.antialiasing);
    part.lens = view::lensPoint(index);
    return part;
}

}  // namespace

struct [[gnu::visibility("hidden")]] Renderer::Impl {  // not public, though in a public class
    gl::ProgramLibrary programs;
    gl::Profiler profiler;
    gl::Device device;
    std::string deviceName;
    bool countLookups = false;
    bool everyFrame = false;

    // The values of a picture, in the order in which they are made.
    scene::HeldScene scene;
    light::Lights lights;
    view::Surfaces surfaces;      // at the pixels' centres
    view::Surfaces partSurfaces;  // beside them, of the view that is drawn for an anti-aliased picture
    std::unique_ptr<modes::ModeRenderer> mode;  // holds those between surfaces and image
    Mode modeKind = Mode::Traced;
    image::LinearImage image;
    image::ViewMean views;
    std::optional<image::TemporalPicture> temporal;
    // Other looks at them.
    image::Display display;
    image::ShadowView shadowMapView;
    image::WireframeView wireframe;
    gl::Buffer lookupCounters{4 * LOOKUPS_WORDS, "lookup counters"};
    // Of the last picture.
    Settings shownSettings;
    FrameStats stats;
    modes::MemoryFit fit;

    Impl(gl::ShaderProvider provider, gl::ExecutionProfile profile)
        : programs(gl::providerFor(profile, std::move(provider))), device{programs, profiler, profile} {}

    void renderWithin(const Camera& camera, int width, int height, const Settings& settings);
    void forgetPicture();
    void render(const Camera& camera, int width, int height, const Settings& settings);
    void prepare(const Settings& settings);
    modes::Frame frame(const Settings& settings);
    void drawLight(const modes::Frame& frame);
    void drawParts(const Camera& camera, const Settings& settings, int count);
    void drawTemporal(const Camera& camera, const Settings& settings);
    void seePart(const Camera& camera, const Settings& settings, const view::PixelPart& part);
    void drawOverlays(const Settings& settings);
    PixelInspection inspect(int x, int y);
    void collectStats(double cpuStart, double wallStart);
};

Renderer::Renderer(const RendererOptions& options) {
    gl::requireContext();
    if (options.reportGlErrors) gl::installDebugCallback();
    impl_ = std::make_unique<Impl>(options.shaderDirectory.empty()
                                       ? gl::embeddedShaderProvider()
                                       : gl::directoryShaderProvider(options.shaderDirectory),
                                   modes::profileOf(options.execution));
    impl_->deviceName = gl::rendererName();
}

Renderer::~Renderer() {
    // Without the context, what it held is gone with it or cannot be freed.
    std::optional<gl::ForgetNames> forget;
    if (!gl::hasCurrentContext()) forget.emplace();
    impl_.reset();
}

void Renderer::setScene(const Scene& scene) {
    scene.validate();  // a scene that is refused leaves the old one in place
    const gl::HostStateGuard guard;
    impl_->mode.reset();  // light of another scene says nothing of this one
    impl_->fit.forget();
    impl_->scene.set(scene);
}

void Renderer::setInstance(std::size_t index, const Instance& instance) {
    impl_->scene.setInstance(index, instance);
}
void Renderer::setMesh(std::size_t index, const Mesh& mesh) { impl_->scene.setMesh(index, mesh); }
void Renderer::setMaterial(std::size_t index, const Material& material) {
    impl_->scene.setMaterial(index, material);
}
void Renderer::setLight(std::size_t index, const Light& light) { impl_->scene.setLight(index, light); }
void Renderer::setLights(const std::vector<Light>& lights) { impl_->scene.setLights(lights); }
void Renderer::setSky(const glm::vec3& radiance) { impl_->scene.setSky(radiance); }
void Renderer::setEnvironment(const Environment& environment) { impl_->scene.setEnvironment(environment); }
void Renderer::setBakedLight(std::shared_ptr<const BakedLight> baked) {
    impl_->scene.setBakedLight(std::move(baked));
}
std::size_t Renderer::addMesh(const Mesh& mesh) { return impl_->scene.addMesh(mesh); }
std::size_t Renderer::addTexture(const Texture& texture) { return impl_->scene.addTexture(texture); }
std::size_t Renderer::addMaterial(const Material& material) { return impl_->scene.addMaterial(material); }
std::size_t Renderer::addInstance(const Instance& instance) { return impl_->scene.addInstance(instance); }
void Renderer::removeInstance(std::size_t index) { impl_->scene.removeInstance(index); }
void Renderer::removeMesh(std::size_t index) { impl_->scene.removeMesh(index); }
void Renderer::setRegion(const Aabb& region) { impl_->scene.setRegion(region); }
const Scene& Renderer::scene() const { return impl_->scene.require("scene").source(); }

void Renderer::setProfiling(bool passes, bool lookups) {
    impl_->profiler.setEnabled(passes);
    impl_->countLookups = lookups;
}

void Renderer::setDynamic(bool everyFrame) { impl_->everyFrame = everyFrame; }

std::vector<std::string> Renderer::reloadShaders() {
    const gl::HostStateGuard guard;
    std::vector<std::string> failures = impl_->programs.reload(impl_->programs.sourceFiles());
    impl_->mode.reset();  // what the old programs left in volumes and shadow maps is theirs
    impl_->lights = {};
    return failures;
}

void Renderer::render(const Camera& camera, int width, int height, const Settings& settings) {
    if (width == 0 || height == 0) return;  // of a window that is minimised
    if (width < 1 || height < 1 || width > view::kMaxEdge || height > view::kMaxEdge)
        base::fail(ErrorKind::Usage, "picture of %d x %d; 1 to %d in each direction would be right", width,
                   height, view::kMaxEdge);
    view::requireUsable(camera);
    validateSettings(settings);
    impl_->scene.require("render");
    const gl::HostStateGuard guard;
    gl::requireLiveContext();
    impl_->renderWithin(camera, width, height, settings);
    gl::requireLiveContext();
}

// With less where the whole does not fit into the memory there may be.
void Renderer::Impl::renderWithin(const Camera& camera, int width, int height, const Settings& settings) {
    bool said = true;
    for (;;) {
        try {
            render(camera, width, height, fit.fitted(settings, width, height));
            break;
        } catch (const gl::MemoryError&) {
            forgetPicture();
            if (!fit.lower(settings)) throw;
            said = false;
        }
    }
    if (!said)
        base::log(LogLevel::Warning,
                  base::format("memory: within %zu MB by ", memoryLimit() >> 20) + fit.text(settings));
}

// All that was made of the scene. It may be half made.
void Renderer::Impl::forgetPicture() {
    mode.reset();
    lights = {};
    surfaces = {};
    partSurfaces = {};
    image = {};
    views = {};
    temporal.reset();
    display = {};
    shadowMapView = {};
    wireframe = {};
}

void Renderer::Impl::render(const Camera& camera, int width, int height, const Settings& settings) {
    const double cpuStart = base::processCpuMs();
    const double wallStart = base::wallMs();
    profiler.beginFrame();
    programs.trim();
    if (everyFrame) scene.require("render").touch();
    lookupCounters.clear();
    image.resize(width, height);
    // Views of surfaces need neither lights nor a mode.
    const bool debugView = image::isDebugView(settings.component);
    if (!debugView || settings.view.voxels) prepare(settings);
    const int count = viewsOfStill(settings, camera);
    const view::PixelPart centers = count > 0 ? view::centersOfStill() : view::PixelPart{};
    const float shrink = settings.view.shrink;
    surfaces.see(device, *scene, {camera, width, height, true, centers, debugView, shrink});
    if (debugView)
        image::drawDebugView(device, *scene, surfaces, settings.component, image.texture());
    else if (settings.component == Component::ShadowMap)
        shadowMapView.draw(device, scene->source(), lights, settings.view.light, image.texture());
    else if (isTemporal(settings))
        drawTemporal(camera, settings);
    else
        drawLight(frame(settings));
    if (count > 0) drawParts(camera, settings, count);
    // Pictures of surfaces between those of light leave it as it is.
    if (temporal && settings.image.temporal != Toggle::On) {
        temporal.reset();
        partSurfaces = {};
    }
    gl::barrier(gl::Access::TextureFetch | gl::Access::Framebuffer | gl::Access::ImageAccess);
    if (settings.component != Component::ShadowMap) drawOverlays(settings);
    shownSettings = settings;
    collectStats(cpuStart, wallStart);
}

// By the mode, and the surroundings behind.
void Renderer::Impl::drawLight(const modes::Frame& frame) {
    mode->draw(frame);
    const Component component = frame.settings.component;
    if (component == Component::Full || component == Component::Direct)
        image::drawBackground(frame.device, frame.scene, frame.lights, frame.surfaces, frame.output);
    if (frame.lights.hasGlass() && isOfLight(component)) mode->drawGlass(frame);
}

void Renderer::Impl::seePart(const Camera& camera, const Settings& settings, const view::PixelPart& part) {
    partSurfaces.see(device, *scene,
                     {.camera = camera,
                      .width = image.width(),
                      .height = image.height(),
                      .cullBackFaces = true,
                      .part = part,
                      .shrink = settings.view.shrink});
}

// Views through points beside the pixels' centres; their mean takes the place of the centres' picture.
void Renderer::Impl::drawParts(const Camera& camera, const Settings& settings, int count) {
    for (int i = 0; i < count; ++i) {
        seePart(camera, settings, partOfStill(settings, i));
        drawLight({.device = device,
                   .scene = *scene,
                   .lights = lights,
                   .surfaces = partSurfaces,
                   .settings = settings,
                   .output = views.view(image.width(), image.height()),
                   .besideCenters = true,
                   .part = i,
                   .parts = count});
        views.add(device, i, image.texture());
    }
}

// One view, and the pictures before. The first picture is that of the pixels' centres.
void Renderer::Impl::drawTemporal(const Camera& camera, const Settings& settings) {
    if (!temporal) temporal.emplace();
    temporal->follow({*scene, camera, image.width(), image.height(), settings});
    if (temporal->fresh())
        drawLight(frame(settings));
    else if (mode->gathersForCenters())
        mode->draw(frame(settings));
    const view::PixelPart part = temporal->part(mode->settled());
    if (temporal->fresh()) {
        gl::barrier(gl::Access::TextureFetch | gl::Access::Framebuffer | gl::Access::ImageAccess |
                    gl::Access::Update);
        temporal->takeCenters(image.texture());
    } else {
        seePart(camera, settings, part);
        drawLight({.device = device,
                   .scene = *scene,
                   .lights = lights,
                   .surfaces = partSurfaces,
                   .settings = settings,
                   .output = temporal->view(),
                   .besideCenters = true,
                   .part = temporal->frame(),
                   .parts = kTemporalViews});
    }
    temporal->add(device, *scene, surfaces, image.texture());
}

// The mode, and the lights as it needs them.
void Renderer::Impl::prepare(const Settings& settings) {
    if (!mode || modeKind != settings.mode) {
        mode.reset();  // frees the old volumes first
        mode = modes::makeModeRenderer(settings.mode);
        modeKind = settings.mode;
    }
    const bool shadows =
        settings.component == Component::ShadowMap || mode->needsShadows(scene->source(), settings);
    lights.update(device, *scene,
                  {settings.light, settings.light.emissiveQuads && mode->lightsFromEmitters(settings),
                   shadows, mode->castsCaustics()});
}

modes::Frame Renderer::Impl::frame(const Settings& settings) {
    return {.device = device,
            .scene = *scene,
            .lights = lights,
            .surfaces = surfaces,
            .settings = settings,
            .output = image.texture(),
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
                       image.texture());
}

void Renderer::Impl::collectStats(double cpuStart, double wallStart) {
    stats = FrameStats{};
    stats.device = deviceName;
    if (!profiler.enabled()) return;
    if (gl::isSoftwareDriver()) gl::finish();
    stats.cpuMs = base::processCpuMs() - cpuStart;
    stats.wallMs = base::wallMs() - wallStart;
    for (const gl::PassTime& pass : profiler.endFrame())
        stats.passes.push_back({pass.name, pass.cpuMs, pass.wallMs, pass.gpuMs});
    if (!countLookups) return;
    const std::vector<std::uint32_t> counts = lookupCounters.read<std::uint32_t>(LOOKUPS_WORDS);
    const double pixels = static_cast<double>(image.width()) * static_cast<double>(image.height());
    const char* const kinds[3] = {"diffuse", "specular", "occlusion"};
    for (std::size_t i = 0; i < 3; ++i)
        stats.lookupsPerPixel.emplace_back(kinds[i],
                                           (counts[i] + 4294967296.0 * counts[LOOKUPS_CARRY + i]) / pixels);
}

Image Renderer::readImage() const {
    if (!impl_->image)
        base::fail(ErrorKind::Usage, "readImage: nothing was rendered; render before it would be right");
    const gl::HostStateGuard guard;
    return impl_->image.read();
}

PixelInspection Renderer::inspectPixel(int x, int y) {
    const image::LinearImage& image = impl_->image;
    if (!image)
        base::fail(ErrorKind::Usage, "inspectPixel: nothing was rendered; render before it would be right");
    if (x < 0 || y < 0 || x >= image.width() || y >= image.height())
        base::fail(ErrorKind::Usage,
                   "inspectPixel: pixel %d,%d of a picture of %d x %d; 0,0 to %d,%d would be right", x, y,
                   image.width(), image.height(), image.width() - 1, image.height() - 1);
    const gl::HostStateGuard guard;
    return impl_->inspect(x, y);
}

// The mode's passes once more, for one pixel, on the surfaces of the last picture.
PixelInspection Renderer::Impl::inspect(int x, int y) {
    prepare(shownSettings);
    gather::StepRecorder recorder({x, image.height() - 1 - y});
    modes::Frame recorded = frame(shownSettings);
    recorded.recorder = &recorder;
    recorded.lookupCounters = nullptr;
    mode->draw(recorded);
    PixelInspection found = recorder.read();
    found.x = x;
    found.y = y;
    found.mode = shownSettings.mode;
    found.picture = image.readPixel(x, y);
    return found;
}

std::uint32_t Renderer::imageTexture() const { return impl_->image ? impl_->image.texture().name() : 0; }

std::uint32_t Renderer::displayTexture(const ImageSettings& settings) {
    if (!impl_->image) return 0;
    const gl::HostStateGuard guard;
    impl_->display.draw(impl_->device, impl_->image.texture(), settings);
    return impl_->display.texture().name();
}

void Renderer::copyToFramebuffer(std::uint32_t framebuffer, int x, int y) const {
    if (!impl_->image)
        base::fail(ErrorKind::Usage, "copyToFramebuffer: nothing was rendered; render before it");
    const gl::HostStateGuard guard;
    gl::copyToFramebuffer(impl_->image.texture(), framebuffer, {x, y});
}

void Renderer::copyToTexture(std::uint32_t texture) const {
    if (!impl_->image) base::fail(ErrorKind::Usage, "copyToTexture: nothing was rendered; render before it");
    const gl::HostStateGuard guard;
    gl::copyToTexture(impl_->image.texture(), texture);
}

const FrameStats& Renderer::stats() const {
    impl_->stats.memory = memoryStats();
    return impl_->stats;
}

}  // namespace conelight
