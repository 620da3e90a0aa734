// SPDX-License-Identifier: MIT
// The path tracer: the truth that pictures of the renderer are measured against.
#include <fmt/core.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <mutex>
#include <optional>

#include "bindings.h"
#include "calls.h"
#include "camera_axes.h"
#include "components.h"
#include "reference/denoise.h"
#include "reference/path_tracer.h"
#include "reference/picture_layers.h"
#include "scene_handle.h"
#include "surfaces.h"

namespace conelight::python {
namespace {

using reference::PathTracedPicture;
using reference::PathTracerProgress;
using reference::PathTracerSettings;

class TracerHandle {
  public:
    explicit TracerHandle(const SceneHandle& scene) : scene_(scene.shared()) {
        unlocked([&] { tracer_.emplace(*scene_); });
    }
    const reference::PathTracer& tracer() const { return *tracer_; }
    // Its rays are made at the first call; the path tracer keeps its own to itself.
    SurfaceTables surfaces(const Camera& camera, const glm::ivec2& size, const Camera* cameraBefore,
                           const Scene* sceneBefore) {
        const std::lock_guard lock(mutex_);
        if (!rays_) rays_.emplace(*scene_);
        if (cameraBefore == nullptr && sceneBefore == nullptr)
            return surfacesOf(*scene_, *rays_, camera, size, 0);
        const SeenBefore before{sceneBefore != nullptr ? *sceneBefore : *scene_,
                                cameraBefore != nullptr ? *cameraBefore : camera};
        checkSeenBefore(*scene_, before);
        return surfacesOf(*scene_, *rays_, camera, size, 0, &before);
    }
    py::dict stats = py::dict();

  private:
    std::shared_ptr<const Scene> scene_;  // as it was; the tracer refers to it
    std::optional<reference::PathTracer> tracer_;
    std::mutex mutex_;
    std::optional<reference::RayScene> rays_;
};

void requirePart(const std::string& name) {
    const PathTracedPicture none;
    if (reference::isTracedLayer(name) || reference::layerOf(none, name) != nullptr) return;
    throw Error(
        ErrorKind::Usage,
        fmt::format("components: the path tracer has no '{}'; full, direct, indirect, diffuse, specular, {} "
                    "would be right",
                    name, reference::tracedLayerNames()));
}

reference::PixelFilter filterOf(const std::string& name) {
    if (name == "center") return reference::PixelFilter::Center;
    if (name == "box") return reference::PixelFilter::Box;
    throw Error(ErrorKind::Usage, "filter: there is no '" + name + "'; 'center' or 'box' would be right");
}

struct TraceRequest {
    std::vector<std::string> components;
    PathTracerSettings settings;
    py::object progress;
    bool alpha = false;
    reference::Denoiser denoiser = reference::Denoiser::None;
};

// None or False, True or 'own', 'oidn'.
reference::Denoiser denoiserOf(const py::object& given) {
    const std::string text = py::str(given);
    if (text == "None" || text == "False") return reference::Denoiser::None;
    if (text == "True" || text == "own") return reference::Denoiser::Own;
    if (text != "oidn")
        throw Error(ErrorKind::Usage,
                    fmt::format("denoise: '{}' is not usable; True, 'own' or 'oidn' would be right", text));
    if (!reference::hasOidn())
        throw Error(ErrorKind::Usage, "denoise: this build has no Open Image Denoise; 'own' would be right");
    return reference::Denoiser::Oidn;
}

TraceRequest requestOf(const py::kwargs& options) {
    Keywords given("reference", options);
    TraceRequest request;
    const py::object named = given.take("components");
    request.components = named.is_none() ? std::vector<std::string>{"full"} : componentNames(named);
    PathTracerSettings& settings = request.settings;
    settings.samplesPerPixel = given.take("samples", settings.samplesPerPixel);
    settings.noise = given.take("noise", settings.noise);
    settings.bounces = bouncesOf(given.take("bounces"), 0);
    settings.seed = given.take("seed", settings.seed);
    settings.filter = filterOf(given.take("filter", std::string("center")));
    settings.threads = given.take("threads", settings.threads);
    request.progress = given.take("progress");
    request.alpha = given.take("alpha", false);
    request.denoiser = denoiserOf(given.take("denoise"));
    settings.features = request.denoiser != reference::Denoiser::None;
    given.finish();
    for (const std::string& name : request.components) {
        requirePart(name);
        settings.perBounce = std::max(settings.perBounce, reference::bounceLayer(name));
    }
    if (settings.samplesPerPixel < 1 || settings.samplesPerPixel > 1 << 20)
        throw Error(ErrorKind::Usage, fmt::format("samples: {} is out of range; 1 to {} would be right",
                                                  settings.samplesPerPixel, 1 << 20));
    if (!(settings.noise >= 0))
        throw Error(ErrorKind::Usage, "noise: is below 0; 0.01 for 1 % would be right");
    if (settings.threads < 0 || settings.threads > 4096)
        throw Error(ErrorKind::Usage, "threads: is out of range; 0 for all cores would be right");
    return request;
}

// Traces without Python's lock; takes it between rounds for the callback and for Ctrl-C.
PathTracedPicture trace(const TracerHandle& tracer, const Camera& camera, const glm::ivec2& size,
                        const TraceRequest& request) {
    ProgressCall progress(request.progress);
    const auto onProgress = [&](const PathTracerProgress& now) { return progress(now); };
    PathTracedPicture picture = unlocked(
        [&] { return tracer.tracer().render(camera, size.x, size.y, request.settings, onProgress); });
    progress.rethrow();
    if (request.settings.features && picture.samplesPerPixel > 0)
        picture = unlocked([&] {
            return reference::denoise(picture, {request.denoiser, request.settings.threads});
        });
    return picture;
}

py::dict render(TracerHandle& tracer, const Camera& camera, const py::object& sizeGiven,
                const py::kwargs& options) {
    const TraceRequest request = requestOf(options);
    checkCamera(camera);
    PathTracedPicture picture = trace(tracer, camera, sizeOf(sizeGiven), request);
    py::dict stats, pictures;
    stats["samples"] = picture.samplesPerPixel;
    stats["noise"] = picture.noise;
    stats["rays"] = picture.rays;
    stats["bad_samples"] = picture.badSamples;
    stats["cpu_seconds"] = picture.cpuSeconds;
    stats["wall_seconds"] = picture.wallSeconds;
    tracer.stats = stats;
    for (const std::string& name : request.components)
        if (!pictures.contains(name.c_str()))
            pictures[name.c_str()] = pictureArray(std::move(*reference::layerOf(picture, name)),
                                                  request.alpha ? Channels::Rgba : Channels::Rgb);
    return pictures;
}

// What the pixels' centres see; the arrays own the tables.
py::dict surfaces(TracerHandle& tracer, const Camera& camera, const py::object& sizeGiven,
                  const std::optional<Camera>& previousCamera, const SceneHandle* previousScene) {
    checkCamera(camera);
    if (previousCamera) checkCamera(*previousCamera);
    const glm::ivec2 size = sizeOf(sizeGiven);
    const std::shared_ptr<const Scene> before = previousScene != nullptr ? previousScene->shared() : nullptr;
    SurfaceTables tables = unlocked([&] {
        return tracer.surfaces(camera, size, previousCamera ? &*previousCamera : nullptr, before.get());
    });
    py::dict all;
    all["instance"] = ownedArray<std::int32_t>(size, std::move(tables.instance));
    all["material"] = ownedArray<std::int32_t>(size, std::move(tables.material));
    all["triangle"] = ownedArray<std::int32_t>(size, std::move(tables.triangle));
    all["depth"] = ownedArray<float>(size, std::move(tables.depth));
    all["position"] = ownedArray<float>(size, std::move(tables.position));
    all["geometric_normal"] = ownedArray<float>(size, std::move(tables.geometricNormal));
    all["normal"] = ownedArray<float>(size, std::move(tables.normal));
    all["uv"] = ownedArray<float>(size, std::move(tables.uv));
    all["base_color"] = ownedArray<float>(size, std::move(tables.baseColor));
    all["metallic"] = ownedArray<float>(size, std::move(tables.metallic));
    all["roughness"] = ownedArray<float>(size, std::move(tables.roughness));
    if (!tables.motion.empty()) all["motion"] = ownedArray<float>(size, std::move(tables.motion));
    return all;
}

constexpr const char* kOptions =
    "By name:\n"
    "samples: per pixel, at most (256). noise: stop below this estimated relative RMSE (0: never).\n"
    "bounces: of indirect light, a number or 'all' ('all'). seed: same seed, same bits (1).\n"
    "filter: 'center', a point of the pixel as the renderer's pictures without anti-aliasing have it, or\n"
    "'box', all of it ('center'). threads: 0 is all cores (0).\n"
    "components: 'full', 'direct', 'indirect', 'diffuse', 'specular'; 'half_a', 'half_b',\n"
    "'indirect_half_a', 'indirect_half_b', of half of the samples each; 'bounce1' to 'bounce64'.\n"
    "denoise: True or 'own' takes out noise, for pictures that are no truth; 'oidn' by Open Image Denoise,\n"
    "where it is built in (False).\n"
    "alpha: a fourth channel (False). progress: called with a Progress between rounds; False stops, and\n"
    "what there is is returned.";

}  // namespace

void bindTracer(py::module_& module) {
    py::class_<PathTracerProgress>(module, "Progress", "How far a path-traced picture is.")
        .def_readonly("samples_done", &PathTracerProgress::samplesDone, "Per pixel.")
        .def_readonly("samples_planned", &PathTracerProgress::samplesPlanned, "Per pixel, at most.")
        .def_readonly("noise", &PathTracerProgress::noise, "Estimated relative RMSE; 0: not known yet.")
        .def_readonly("seconds_left", &PathTracerProgress::secondsLeft, "Below 0: not known yet.");
    static const std::string renderDoc =
        std::string("Radiance as a dict of float32 arrays (height, width, 3), first row on top.\n\n") +
        kOptions;
    py::class_<TracerHandle>(module, "PathTracer",
                             "The path tracer of a scene as it is now; for several pictures of one scene.")
        .def(py::init<const SceneHandle&>(), py::arg("scene"))
        .def("render", &render, py::arg("camera"), py::arg("size"), renderDoc.c_str())
        .def("surfaces", &surfaces, py::arg("camera"), py::arg("size"), py::kw_only(),
             py::arg("previous_camera") = py::none(), py::arg("previous_scene") = py::none(),
             "What the pixels' centres see, as a dict of arrays, first row on top; by rays, without "
             "OpenGL.\n\n"
             "instance, material, triangle: (height, width) int32, numbers in the scene and the mesh; -1 is "
             "none,\n"
             "or the default material. depth: (height, width), metres along the view. position: (height, "
             "width,\n"
             "3), world, metres. geometric_normal, normal: (height, width, 3), of the triangle and as it is\n"
             "shaded. uv: (height, width, 2). base_color: (height, width, 3). metallic, roughness: (height,\n"
             "width). All but the first three are float32, and 0 where nothing is.\n\n"
             "previous_camera, previous_scene: of the picture before, for motion: (height, width, 2), where "
             "a\n"
             "pixel's surface point was in it less where it is now, pixels, x to the right, y down. The "
             "scene is\n"
             "the same at another time: same instances, as many vertices. One that is not given is as now.")
        .def_property_readonly(
            "stats", [](const TracerHandle& tracer) { return tracer.stats; },
            "Of the last picture: samples, noise, rays, bad_samples, cpu_seconds, wall_seconds.");
    static const std::string referenceDoc =
        std::string(
            "The true picture of a scene by the path tracer: PathTracer(scene).render(camera, size).\n\n") +
        kOptions;
    module.def(
        "reference",
        [](const SceneHandle& scene, const Camera& camera, const py::object& size,
           const py::kwargs& options) {
            requestOf(options);  // wrong ones are found before the work starts
            TracerHandle tracer(scene);
            return render(tracer, camera, size, options);
        },
        py::arg("scene"), py::arg("camera"), py::arg("size"), referenceDoc.c_str());
}

}  // namespace conelight::python
