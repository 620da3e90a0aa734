// SPDX-License-Identifier: MIT
#include "picture_source.h"

#include <algorithm>

#include "conelight/error.h"

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

}  // namespace

bool isModeName(const std::string& name) { return name == "phong" || name == "thesis" || name == "cones"; }

std::string modeNames() { return "phong, thesis or cones"; }

void requireModeName(const std::string& name) {
    if (isModeName(name)) return;
    throw Error(ErrorKind::Usage, "--mode: there is no '" + name + "'; " + modeNames() + " would be right");
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
    const Scene* uploaded = nullptr;  // what the renderer holds

    Renderer& rendererOf(const Scene& wanted, Progress* progress);
    void drawGl(const Scene& drawn, const PictureRequest& request, Picture& picture, Progress* progress);
    FrameCost costOf(const PictureRequest& request, const Settings& settings);
};

PictureSource::PictureSource(const ViewOptions& view, const std::string& shaderDirectory)
    : impl_(std::make_unique<Impl>()) {
    impl_->view = view;
    impl_->shaderDirectory = shaderDirectory;
}

PictureSource::~PictureSource() = default;

void PictureSource::setScene(const Scene& scene) {
    impl_->scene = &scene;
    impl_->uploaded = nullptr;
}

std::string PictureSource::device() const { return impl_->context ? impl_->context->description() : ""; }

// The renderer with `wanted` in it; makes the context at the first call.
Renderer& PictureSource::Impl::rendererOf(const Scene& wanted, Progress* progress) {
    if (!renderer) {
        show(progress, "starting OpenGL");
        context = openContext(view);
        renderer = std::make_unique<Renderer>(RendererOptions{shaderDirectory, view.debugGl});
    }
    if (uploaded != &wanted) {
        show(progress, "uploading the scene");
        renderer->setScene(wanted);
        uploaded = &wanted;
    }
    return *renderer;
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
    renderer->setProfiling(false, false);
    return cost;
}

void PictureSource::Impl::drawGl(const Scene& drawn, const PictureRequest& request, Picture& picture,
                                 Progress* progress) {
    Renderer& gl = rendererOf(drawn, progress);
    Settings settings = request.settings;
    setSetting(settings, "mode", request.mode);
    for (const Component component : request.components) {
        const bool first = picture.images.empty();
        settings.component = component;
        show(progress, "rendering " + getSetting(settings, "component"));
        gl.setProfiling(first && request.profile, first && request.profile);
        for (int frame = 0; frame < (first ? request.frames : 1); ++frame)
            gl.render(request.camera, request.size.width, request.size.height, settings);
        picture.images.push_back(gl.readImage());
        if (!first) continue;
        picture.stats = gl.stats();
        if (request.timedFrames > 0) picture.cost = costOf(request, settings);
    }
}

Picture PictureSource::draw(const PictureRequest& request, Progress* progress) {
    requireModeName(request.mode);
    if (impl_->scene == nullptr)
        throw Error(ErrorKind::Usage,
                    "PictureSource: there is no scene; setScene before draw would be right");
    Picture picture;
    impl_->drawGl(*impl_->scene, request, picture, progress);
    return picture;
}

}  // namespace conelight::program
