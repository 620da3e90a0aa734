// SPDX-License-Identifier: MIT
// The renderer with an OpenGL context of its own, current only during calls: any thread may call, one at a time.
#include <fmt/core.h>
#include <pybind11/stl.h>

#include <mutex>

#include "bindings.h"
#include "calls.h"
#include "camera_axes.h"
#include "components.h"
#include "conelight/renderer.h"
#include "platform/headless_context.h"
#include "scene_handle.h"
#include "settings_argument.h"

namespace conelight::python {
namespace {

// A scene as it was when a call began.
struct Snapshot {
    std::shared_ptr<const Scene> scene;
    std::uint64_t geometry = 0;
    explicit Snapshot(const SceneHandle& handle) : scene(handle.shared()), geometry(handle.geometry()) {}
};

struct PictureRequest {
    Camera camera;
    glm::ivec2 size{0};
    Settings settings;
    std::vector<Component> components;
    bool profile = false;
};

// Whether the renderer can go from `held` to `wanted` by changes in place; both have the same meshes and textures.
bool isChange(const Scene& held, const Scene& wanted) {
    if (held.instances.size() != wanted.instances.size() || held.materials.size() != wanted.materials.size())
        return false;
    for (std::size_t i = 0; i < held.instances.size(); ++i)
        if (held.instances[i].mesh != wanted.instances[i].mesh) return false;
    return true;
}

class RendererHandle {
  public:
    RendererHandle(int device, const std::string& shaderDirectory, bool debug) {
        platform::HeadlessOptions options;
        options.device = device;
        options.debug = debug;
        context_ = std::make_unique<platform::HeadlessContext>(options);
        RendererOptions rendererOptions;
        rendererOptions.shaderDirectory = shaderDirectory;
        rendererOptions.reportGlErrors = debug;
        renderer_ = std::make_unique<Renderer>(rendererOptions);
        context_->release();
    }
    ~RendererHandle() {
        try {
            const platform::CurrentContext current(*context_);
            renderer_.reset();
        } catch (const Error&) {
            // No context: what it held is gone with it or cannot be freed.
            static_cast<void>(renderer_.release());
        }
    }
    RendererHandle(const RendererHandle&) = delete;
    RendererHandle& operator=(const RendererHandle&) = delete;

    void setScene(const Snapshot& snapshot) {
        const std::lock_guard lock(mutex_);
        const platform::CurrentContext current(*context_);
        uploadAnew(snapshot);
    }

    std::vector<Image> render(const Snapshot* snapshot, const PictureRequest& request) {
        const std::lock_guard lock(mutex_);
        const platform::CurrentContext current(*context_);
        if (snapshot != nullptr) follow(*snapshot);
        if (geometry_ == 0)
            throw Error(ErrorKind::Usage,
                        "scene: there is none; render(scene, ...) or set_scene first would be right");
        renderer_->setProfiling(request.profile, false);
        std::vector<Image> images;
        for (const Component component : request.components) {
            Settings shown = request.settings;
            shown.component = component;
            renderer_->render(request.camera, request.size.x, request.size.y, shown);
            images.push_back(renderer_->readImage());
        }
        stats_ = renderer_->stats();
        return images;
    }

    std::string device() const { return context_->description(); }
    FrameStats stats() {
        const std::lock_guard lock(mutex_);
        return stats_;
    }

  private:
    void uploadAnew(const Snapshot& snapshot) {
        geometry_ = 0;  // a scene that is refused is none
        renderer_->setScene(*snapshot.scene);
        geometry_ = snapshot.geometry;
    }

    // Uploads what differs from the scene that the renderer holds, and nothing else.
    void follow(const Snapshot& snapshot) {
        const Scene& wanted = *snapshot.scene;
        if (geometry_ != snapshot.geometry || !isChange(renderer_->scene(), wanted))
            return uploadAnew(snapshot);
        const Scene& held = renderer_->scene();
        for (std::size_t i = 0; i < wanted.materials.size(); ++i)
            if (!(held.materials[i] == wanted.materials[i])) renderer_->setMaterial(i, wanted.materials[i]);
        for (std::size_t i = 0; i < wanted.instances.size(); ++i)
            if (!(held.instances[i] == wanted.instances[i])) renderer_->setInstance(i, wanted.instances[i]);
        if (held.lights != wanted.lights) renderer_->setLights(wanted.lights);
        if (held.sky != wanted.sky) renderer_->setSky(wanted.sky);
        if (!(held.environment == wanted.environment)) renderer_->setEnvironment(wanted.environment);
    }

    std::mutex mutex_;
    std::unique_ptr<platform::HeadlessContext> context_;
    std::unique_ptr<Renderer> renderer_;
    std::uint64_t geometry_ = 0;  // of the scene that the renderer holds; 0: none
    FrameStats stats_;
};

// The component holds (1 + n) / 2; the mean of an anti-aliased still that over its share of the pixel.
void decodeNormals(Image& image) {
    for (glm::vec4& pixel : image.pixels) pixel = {2.0f * glm::vec3(pixel) - pixel.a, pixel.a};
}

void checkDevice(const std::optional<int>& device) {
    if (!device) return;
    const int count = static_cast<int>(platform::listDevices().size());
    if (count > 0 && (*device < 0 || *device >= count))
        throw Error(ErrorKind::Usage,
                    fmt::format("device: there is no EGL device {}; None, or 0 to {}, would be right",
                                *device, count - 1));
}

Camera cameraOf(const SceneHandle* scene, const py::object& given) {
    if (py::isinstance<Camera>(given)) return given.cast<Camera>();
    if (!given.is_none()) throw py::type_error("camera: a Camera or None would be right");
    if (scene == nullptr) throw Error(ErrorKind::Usage, "camera: there is none; a Camera would be right");
    return scene->get().cameras.empty() ? frameCamera(scene->get().bounds()) : scene->get().cameras.front();
}

py::dict render(RendererHandle& renderer, const SceneHandle* scene, const py::object& camera,
                const py::object& size, const py::object& settings, const py::kwargs& options) {
    Keywords given("render", options);
    const py::object named = given.take("components");
    const bool alpha = given.take("alpha", false);
    PictureRequest request;
    request.profile = given.take("profile", false);
    given.finish();
    const std::vector<std::string> names =
        named.is_none() ? std::vector<std::string>{"full"} : componentNames(named);
    for (const std::string& name : names) request.components.push_back(componentOf(name));
    request.size = sizeOf(size);
    request.settings = settingsOf(settings);
    request.camera = cameraOf(scene, camera);
    checkCamera(request.camera);
    std::optional<Snapshot> snapshot;
    if (scene != nullptr) snapshot.emplace(*scene);
    std::vector<Image> images =
        unlocked([&] { return renderer.render(snapshot ? &*snapshot : nullptr, request); });
    py::dict pictures;
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (request.components[i] == Component::Normal) decodeNormals(images[i]);
        pictures[names[i].c_str()] = pictureArray(std::move(images[i]), channelsOf(names[i], alpha));
    }
    return pictures;
}

py::dict statsOf(RendererHandle& renderer) {
    const FrameStats stats = renderer.stats();
    py::dict all;
    py::list passes;
    std::size_t bytes = 0;
    for (const MemoryStats& object : stats.memory) bytes += object.bytes;
    for (const PassStats& pass : stats.passes) {
        py::dict one;
        one["name"] = pass.name;
        one["cpu_ms"] = pass.cpuMs;
        one["wall_ms"] = pass.wallMs;
        one["gpu_ms"] = pass.gpuMs >= 0 ? py::object(py::float_(pass.gpuMs)) : py::none();
        passes.append(one);
    }
    all["cpu_ms"] = stats.cpuMs;
    all["wall_ms"] = stats.wallMs;
    all["passes"] = passes;
    all["memory_bytes"] = bytes;
    return all;
}

}  // namespace

void bindRenderer(py::module_& module) {
    py::class_<RendererHandle>(
        module, "Renderer",
        "Draws scenes by OpenGL, without a display. Holds its own context and the last scene.\n\n"
        "device: number of an EGL device (devices() lists them); None: a GPU, else software.\n"
        "shader_directory: shaders there win over the built-in ones. debug: messages of the driver go to\n"
        "logging.getLogger('conelight'); slower. Calls from several threads wait for each other.")
        .def(py::init([](std::optional<int> device, const std::string& shaders, bool debug) {
                 checkDevice(device);
                 return unlocked([&] {
                     return std::make_unique<RendererHandle>(device.value_or(platform::kAnyDevice), shaders,
                                                             debug);
                 });
             }),
             py::arg("device") = py::none(), py::kw_only(), py::arg("shader_directory") = "",
             py::arg("debug") = false)
        .def(
            "set_scene",
            [](RendererHandle& renderer, const SceneHandle& scene) {
                const Snapshot snapshot(scene);
                unlocked([&] { renderer.setScene(snapshot); });
            },
            py::arg("scene"), "Uploads all of a scene, and places the voxels anew.")
        .def("render", &render, py::arg("scene"), py::arg("camera"), py::arg("size"),
             py::arg("settings") = py::none(),
             "Pictures of a scene as a dict of float32 arrays, first row on top.\n\n"
             "scene: None is the last one; of one that changed, what changed is uploaded. camera: None is "
             "the\n"
             "scene's first. size: (width, height). settings: Settings or a dict of values. By name: "
             "components, alpha, profile.\n"
             "components: 'full', 'direct', 'indirect', 'diffuse', 'specular', 'emission', 'voxels': "
             "radiance,\n"
             "W/(sr m^2), (height, width, 3); 'albedo', (height, width, 3); 'normal', (height, width, 3), "
             "unit\n"
             "vectors of the world; 'depth', (height, width), metres along the view, 0 where nothing is;\n"
             "'occlusion', (height, width), open part of the hemisphere. alpha=True: colours have a fourth\n"
             "channel, 1 where a surface is seen. profile=True: times for stats.")
        .def_property_readonly(
            "stats", &statsOf,
            "Of the last picture: memory_bytes; with profile=True cpu_ms, wall_ms and passes.")
        .def_property_readonly("device", &RendererHandle::device, "The OpenGL device in words.");
    module.def("devices", &platform::listDevices, "EGL devices, one line each, by number.");
}

}  // namespace conelight::python
