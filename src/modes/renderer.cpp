// SPDX-License-Identifier: MIT
// The frame, top to bottom: what is uploaded, what is rebuilt, which passes run in which order.
#include "conelight/renderer.h"

#include <algorithm>
#include <optional>
#include "conelight/thesis/settings.h"

#include "base/clock.h"
#include "base/log.h"
#include "gather/thesis_cones.h"
#include "gl/debug.h"
#include "gl/gl.h"
#include "gl/host_state.h"
#include "image/debug_view.h"
#include "image/display.h"
#include "image/shadow_view.h"
#include "image/wireframe.h"
#include "light/emissive_quads.h"
#include "modes/modes.h"
#include "scene/scene_checks.h"
#include "shared/bindings.h"
#include "shared/lookups.h"
#include "view/camera.h"

namespace conelight {
namespace {

constexpr int kMaxEdge = 16384;  // GL's minimum for GL_MAX_TEXTURE_SIZE in 4.5

// Textures of one picture size.
struct Targets {
    int width, height;
    view::GBuffer gbuffer;
    gl::Texture output;

    Targets(int w, int h)
        : width(w),
          height(h),
          gbuffer(w, h),
          output({GL_TEXTURE_2D, GL_RGBA32F, w, h, 1, 1}, "output image") {}
};

std::vector<MemoryStats> memoryStats() {
    std::vector<MemoryStats> memory;
    for (const gl::LiveObject& object : gl::liveObjects())
        if (object.bytes > 0) memory.push_back({object.label, object.bytes});
    std::stable_sort(memory.begin(), memory.end(),
                     [](const auto& a, const auto& b) { return a.bytes > b.bytes; });
    return memory;
}

}  // namespace

struct Renderer::Impl {
    gl::ProgramLibrary programs;
    gl::Profiler profiler;
    std::string device;
    bool countLookups = false;
    bool everyFrame = false;

    Scene source;
    std::optional<scene::GpuScene> scene;
    light::ShadowMaps shadows;
    std::optional<Targets> targets;
    image::Display display;
    image::ShadowView shadowMapView;
    image::WireframeView wireframe;
    gpu::FrameConstants constants{};
    gl::Buffer frameBlock{sizeof(gpu::FrameConstants), "frame constants"};
    gl::Buffer lookupCounters{4 * LOOKUPS_WORDS, "lookup counters"};

    // What the current volumes were built for.
    std::unique_ptr<modes::ModeRenderer> mode;
    Mode modeKind = Mode::Traced;
    std::optional<Settings> builtFor;
    bool sceneChanged = true;
    std::uint64_t geometryRevision = 0, lightRevision = 0;
    bool shadowsCurrent = false;
    bool allShadows = false;  // also those that see no change
    bool emittersAreLights = false;
    bool geometryChanged = true;
    bool lightChanged = true;
    bool skyChanged = false;
    std::uint32_t frameIndex = 0;
    // Of the last picture.
    Camera shownCamera;
    Settings shownSettings;
    FrameStats stats;

    explicit Impl(gl::ShaderProvider provider) : programs(std::move(provider)) {}

    // Throw Error(Usage) without a scene or for an index out of range.
    void requireScene(const char* call) const;
    static void requireIndex(const char* call, const char* what, std::size_t index, std::size_t count);

    void render(const Camera& camera, int width, int height, const Settings& settings);
    void prepareMode(const Settings& settings);
    modes::FrameContext context(const Settings& settings);
    void markBuilt(const Settings& settings);
    void drawMode(const Settings& settings);
    void drawOverlays(const Settings& settings);
    PixelInspection inspect(int x, int y);
    void collectStats(double cpuStart, double wallStart);
};

Renderer::Renderer(const RendererOptions& options) {
    gl::requireContext();
    if (options.reportGlErrors) gl::installDebugCallback();
    impl_ = std::make_unique<Impl>(options.shaderDirectory.empty()
                                       ? gl::embeddedShaderProvider()
                                       : gl::directoryShaderProvider(options.shaderDirectory));
    impl_->device = gl::rendererName();
}

Renderer::~Renderer() = default;

void Renderer::setScene(const Scene& scene) {
    scene.validate();  // a scene that is refused leaves the old one in place
    const gl::HostStateGuard guard;
    impl_->scene.reset();
    impl_->source = scene;
    impl_->scene.emplace(impl_->source);
    impl_->sceneChanged = true;
    impl_->mode.reset();  // light and dead faces of another scene say nothing of this one
}

void Renderer::Impl::requireScene(const char* call) const {
    if (!scene)
        base::fail(ErrorKind::Usage, "%s: there is no scene; setScene before it would be right", call);
}

void Renderer::Impl::requireIndex(const char* call, const char* what, std::size_t index, std::size_t count) {
    if (index >= count)
        base::fail(ErrorKind::Usage, "%s: %s %zu of %zu; an index below that would be right", call, what,
                   index, count);
}

void Renderer::setInstance(std::size_t index, const Instance& instance) {
    impl_->requireScene("setInstance");
    std::vector<Instance>& instances = impl_->source.instances;
    Impl::requireIndex("setInstance", "instance", index, instances.size());
    scene::validateInstance(impl_->source, instance, index);
    if (instance.mesh != instances[index].mesh)
        base::fail(ErrorKind::BadInput, "instance %zu '%s': mesh %d; the mesh it has, %d, would be right",
                   index, instance.name.c_str(), instance.mesh, instances[index].mesh);
    const gl::HostStateGuard guard;
    instances[index] = instance;
    impl_->scene->setInstance(index, instance);
}

void Renderer::setMaterial(std::size_t index, const Material& material) {
    impl_->requireScene("setMaterial");
    Impl::requireIndex("setMaterial", "material", index, impl_->source.materials.size());
    scene::validateMaterial(impl_->source, material);
    const gl::HostStateGuard guard;
    impl_->source.materials[index] = material;
    impl_->scene->setMaterial(index, material);
}

void Renderer::setLight(std::size_t index, const Light& light) {
    impl_->requireScene("setLight");
    Impl::requireIndex("setLight", "light", index, impl_->source.lights.size());
    std::vector<Light> lights = impl_->source.lights;
    lights[index] = light;
    setLights(lights);
}

void Renderer::setLights(const std::vector<Light>& lights) {
    impl_->requireScene("setLights");
    for (const Light& light : lights) scene::validateLight(light);
    const gl::HostStateGuard guard;
    impl_->source.lights = lights;
    impl_->scene->setLights(lights);
}

void Renderer::setSky(const glm::vec3& radiance) {
    impl_->requireScene("setSky");
    scene::validateSky(radiance);
    impl_->source.sky = radiance;
    impl_->skyChanged = true;
}

const Scene& Renderer::scene() const {
    impl_->requireScene("scene");
    return impl_->source;
}

void Renderer::setProfiling(bool passes, bool lookups) {
    impl_->profiler.setEnabled(passes);
    impl_->countLookups = lookups;
}

void Renderer::setDynamic(bool everyFrame) { impl_->everyFrame = everyFrame; }

std::vector<std::string> Renderer::reloadShaders() {
    const gl::HostStateGuard guard;
    std::vector<std::string> failures = impl_->programs.reload(impl_->programs.sourceFiles());
    impl_->mode.reset();  // what the old programs left in volumes and shadow maps is theirs
    impl_->allShadows = true;
    impl_->sceneChanged = true;
    return failures;
}

void Renderer::render(const Camera& camera, int width, int height, const Settings& settings) {
    if (width < 1 || height < 1 || width > kMaxEdge || height > kMaxEdge)
        base::fail(ErrorKind::Usage, "picture of %d x %d; 1 to %d in each direction would be right", width,
                   height, kMaxEdge);
    validateSettings(settings);
    impl_->requireScene("render");
    const gl::HostStateGuard guard;
    impl_->render(camera, width, height, settings);
}

void Renderer::Impl::render(const Camera& camera, int width, int height, const Settings& settings) {
    const double cpuStart = base::processCpuMs();
    const double wallStart = base::wallMs();
    profiler.beginFrame();
    if (!targets || targets->width != width || targets->height != height) {
        targets.reset();
        targets.emplace(width, height);
    }

    // Frame constants. Shadow maps come first where they are needed: they complete the light table.
    const bool debugView = image::isDebugView(settings.component);
    scene->bind();
    const bool shadowView = settings.component == Component::ShadowMap;
    if (!debugView || settings.view.voxels) prepareMode(settings);
    constants = view::frameConstants(camera, width, height, *scene, source.sky, frameIndex++, 0);
    frameBlock.update(constants);
    frameBlock.bindUniform(BINDING_FRAME);
    lookupCounters.clear();

    // What the camera sees, then the mode's picture of it.
    targets->gbuffer.draw(programs, profiler, *scene, debugView || mode->cullsBackFaces());
    gl::barrier(gl::Access::TextureFetch | gl::Access::ShaderStorage);
    if (debugView)
        image::drawDebugView(programs, profiler, targets->gbuffer, settings.component, targets->output);
    else if (shadowView)
        shadowMapView.draw(programs, profiler, source, *scene, settings.view.light, targets->output);
    else
        drawMode(settings);
    gl::barrier(gl::Access::TextureFetch | gl::Access::Framebuffer | gl::Access::ImageAccess);
    if (!shadowView) drawOverlays(settings);
    scene->endFrame();
    shownCamera = camera;
    shownSettings = settings;
    collectStats(cpuStart, wallStart);
}

// The mode's renderer, what it has to rebuild, and the shadow maps it reads.
void Renderer::Impl::prepareMode(const Settings& settings) {
    if (!mode || modeKind != settings.mode) {
        mode.reset();  // frees the old volumes first
        mode = modes::makeModeRenderer(settings.mode);
        modeKind = settings.mode;
        builtFor.reset();
    }
    geometryChanged = sceneChanged || everyFrame || !builtFor || !(builtFor->voxels == settings.voxels) ||
                      geometryRevision != scene->geometryRevision();
    // Flat emitters as lights; in the thesis's program emissive objects light nothing (a defect).
    const bool emitters =
        settings.light.emissiveQuads &&
        !(settings.mode == thesis::kMode &&
          gather::effectiveDefects(settings.groups.of<thesis::ThesisSettings>()).darkEmitters);
    lightChanged = geometryChanged || skyChanged || lightRevision != scene->lightRevision() ||
                   !(builtFor->light == settings.light) || emitters != emittersAreLights;
    if (lightChanged) {
        shadowsCurrent = false;
        light::setEmissiveQuads(*scene, source, emitters);
        emittersAreLights = emitters;
        scene->bind();  // the light table may have moved
    }

    // Shadow maps; they fill in the light table that later passes read.
    const bool wantsShadows =
        settings.component == Component::ShadowMap || mode->needsShadowsIn(source, settings);
    if (wantsShadows && !shadowsCurrent) {
        shadows.update(programs, profiler, *scene, settings.light, everyFrame || allShadows);
        allShadows = false;
        scene->bind();
        shadowsCurrent = true;
    }
    shadows.bind();
}

modes::FrameContext Renderer::Impl::context(const Settings& settings) {
    return {programs,       profiler,        source,
            *scene,         settings,        constants,
            targets->width, targets->height, targets->gbuffer,
            shadows,        targets->output, geometryChanged,
            everyFrame,     lightChanged,    countLookups ? &lookupCounters : nullptr};
}

void Renderer::Impl::drawMode(const Settings& settings) {
    mode->render(context(settings));
    markBuilt(settings);
}

// Voxels among the objects, edges of triangles.
void Renderer::Impl::drawOverlays(const Settings& settings) {
    if (settings.view.voxels && settings.component != Component::Voxels && settings.mode != Mode::Phong) {
        Settings voxels = settings;
        voxels.component = Component::Voxels;
        modes::FrameContext among = context(voxels);
        // What the picture was drawn with is up to date.
        if (!image::isDebugView(settings.component)) among.geometryChanged = among.lightChanged = false;
        among.voxelsAmong = true;
        mode->render(among);
        markBuilt(settings);
        gl::barrier(gl::Access::TextureFetch | gl::Access::Framebuffer);
    }
    if (settings.view.wireframe != Wireframe::Off)
        wireframe.draw(programs, profiler, *scene, targets->gbuffer, settings.view.wireframe,
                       settings.image.exposure, source.sky, true, targets->output);
}

void Renderer::Impl::markBuilt(const Settings& settings) {
    sceneChanged = skyChanged = false;
    geometryRevision = scene->geometryRevision();
    lightRevision = scene->lightRevision();
    builtFor = settings;
}

void Renderer::Impl::collectStats(double cpuStart, double wallStart) {
    stats = FrameStats{};
    stats.device = device;
    if (!profiler.enabled()) {
        stats.memory = memoryStats();
        return;
    }
    if (gl::isSoftwareDriver()) gl::finish();
    stats.cpuMs = base::processCpuMs() - cpuStart;
    stats.wallMs = base::wallMs() - wallStart;
    for (const gl::PassTime& pass : profiler.endFrame())
        stats.passes.push_back({pass.name, pass.cpuMs, pass.wallMs, pass.gpuMs});
    stats.memory = memoryStats();
    if (!countLookups) return;
    const std::vector<std::uint32_t> counts = lookupCounters.read<std::uint32_t>(LOOKUPS_WORDS);
    const double pixels = static_cast<double>(targets->width) * static_cast<double>(targets->height);
    const char* const kinds[3] = {"diffuse", "specular", "occlusion"};
    for (std::size_t i = 0; i < 3; ++i)
        stats.lookupsPerPixel.emplace_back(kinds[i],
                                           (counts[i] + 4294967296.0 * counts[LOOKUPS_CARRY + i]) / pixels);
}

Image Renderer::readImage() const {
    if (!impl_->targets)
        base::fail(ErrorKind::Usage, "readImage: nothing was rendered; render before it would be right");
    const gl::HostStateGuard guard;
    const Targets& targets = *impl_->targets;
    Image image{targets.width, targets.height, {}};
    const std::size_t width = static_cast<std::size_t>(targets.width);
    image.pixels.resize(width * static_cast<std::size_t>(targets.height));
    targets.output.read(0, GL_RGBA, GL_FLOAT, image.pixels.data(), image.pixels.size() * sizeof(glm::vec4));
    // GL's first row is the lowest.
    for (std::size_t low = 0, high = static_cast<std::size_t>(targets.height) - 1; low < high; ++low, --high)
        std::swap_ranges(&image.pixels[low * width], &image.pixels[low * width] + width,
                         &image.pixels[high * width]);
    return image;
}

PixelInspection Renderer::inspectPixel(int x, int y) {
    if (!impl_->targets)
        base::fail(ErrorKind::Usage, "inspectPixel: nothing was rendered; render before it would be right");
    const Targets& targets = *impl_->targets;
    if (x < 0 || y < 0 || x >= targets.width || y >= targets.height)
        base::fail(ErrorKind::Usage,
                   "inspectPixel: pixel %d,%d of a picture of %d x %d; 0,0 to %d,%d would be right", x, y,
                   targets.width, targets.height, targets.width - 1, targets.height - 1);
    PixelInspection found;
    {
        const gl::HostStateGuard guard;
        found = impl_->inspect(x, y);
    }
    found.picture = readImage().pixels[static_cast<std::size_t>(y * targets.width + x)];
    return found;
}

// The mode's passes once more, for one pixel, on the G-buffer of the last picture.
PixelInspection Renderer::Impl::inspect(int x, int y) {
    const bool wasEveryFrame = everyFrame;
    everyFrame = false;
    scene->bind();
    prepareMode(shownSettings);
    constants = view::frameConstants(shownCamera, targets->width, targets->height, *scene, source.sky,
                                     constants.frameIndex, 0);
    frameBlock.update(constants);
    frameBlock.bindUniform(BINDING_FRAME);
    gather::StepRecorder recorder({x, targets->height - 1 - y});
    mode->record(context(shownSettings), recorder);
    markBuilt(shownSettings);
    everyFrame = wasEveryFrame;
    PixelInspection found = recorder.read();
    found.x = x;
    found.y = y;
    found.mode = shownSettings.mode;
    return found;
}

std::uint32_t Renderer::imageTexture() const { return impl_->targets ? impl_->targets->output.name() : 0; }

std::uint32_t Renderer::displayTexture(const ImageSettings& settings) {
    if (!impl_->targets) return 0;
    const gl::HostStateGuard guard;
    impl_->display.draw(impl_->programs, impl_->targets->output, settings);
    return impl_->display.texture().name();
}

const FrameStats& Renderer::stats() const { return impl_->stats; }

}  // namespace conelight
