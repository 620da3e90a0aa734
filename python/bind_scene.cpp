// SPDX-License-Identifier: MIT
// Scenes: from files and builtins, or built from arrays.
#include <fmt/core.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cmath>

#include "arrays.h"
#include "bindings.h"
#include "calls.h"
#include "camera_axes.h"
#include "io/animation.h"
#include "io/environment_file.h"
#include "io/generated.h"
#include "io/gltf_write.h"
#include "io/scene_file.h"
#include "io/scene_info.h"
#include "parts.h"
#include "session/session.h"

namespace conelight::python {
namespace {

using Handle = std::shared_ptr<SceneHandle>;

bool isPath(const py::object& given) {
    return py::isinstance<py::str>(given) || py::hasattr(given, "__fspath__");
}

// A path or a builtin's name.
std::string pathOf(const py::object& given) {
    if (!isPath(given)) throw py::type_error("path: text or a path would be right");
    return py::str(py::module_::import("os").attr("fspath")(given));
}

Handle load(const py::object& given, bool complete, bool allowOutside) {
    const std::string path = pathOf(given);
    return unlocked([&] {
        io::LoadOptions options;
        options.allowOutside = allowOutside;
        auto movement = std::make_shared<Movement>();
        Scene scene = io::loadMovingScene(path, options, movement->animation);
        if (complete) completeScene(scene);
        movement->rest.instances = scene.instances;
        movement->rest.lights = scene.lights;
        movement->rest.cameras = scene.cameras;
        auto handle = std::make_shared<SceneHandle>(std::move(scene));
        if (!movement->animation.clips.empty()) handle->movement = std::move(movement);
        return handle;
    });
}

// The elements of one of the scene's vectors as a sequence of handles.
template <class T, std::vector<T> Scene::*List>
struct PartList {
    Handle scene;
    std::size_t size() const { return (scene->get().*List).size(); }
    Part<T, List> at(py::ssize_t index) const {
        const auto count = static_cast<py::ssize_t>(size());
        if (index < -count || index >= count) throw py::index_error("there is no such element in the scene");
        return {scene, static_cast<std::size_t>(index < 0 ? index + count : index)};
    }
    py::tuple slice(const py::slice& wanted) const {
        py::ssize_t start = 0, stop = 0, step = 0, count = 0;
        if (!wanted.compute(static_cast<py::ssize_t>(size()), &start, &stop, &step, &count))
            throw py::error_already_set();
        py::tuple all(count);
        for (py::ssize_t i = 0; i < count; ++i) all[static_cast<std::size_t>(i)] = at(start + i * step);
        return all;
    }
};

// The property of that name. Python iterates by number until there is none.
template <class T, std::vector<T> Scene::*List>
void bindList(py::class_<SceneHandle, Handle>& scene, const char* name) {
    using Parts = PartList<T, List>;
    const std::string word = name;
    py::class_<Parts>(scene, ("_" + word).c_str(), "A sequence of handles.")
        .def("__len__", &Parts::size)
        .def("__getitem__", &Parts::at)
        .def("__getitem__", &Parts::slice)
        .def("__repr__", [word](const Parts& parts) {
            return fmt::format("<{} {} of a conelight.Scene>", parts.size(), word);
        });
    scene.def_property_readonly(
        name, [](const Handle& s) { return Parts{s}; }, "Handles of all, a sequence.");
}

MeshPart addMesh(const Handle& scene, const py::object& positions, const py::object& indices,
                 const py::kwargs& attributes) {
    Mesh mesh = meshOf(positions, indices, attributes);
    scene->editGeometry().meshes.push_back(std::move(mesh));
    return {scene, scene->get().meshes.size() - 1};
}

int addTexture(const Handle& scene, const py::object& pixels, const py::kwargs& options) {
    Texture texture = textureOf(pixels, options);
    scene->editGeometry().textures.push_back(std::move(texture));
    return static_cast<int>(scene->get().textures.size()) - 1;
}

MaterialPart addMaterial(const Handle& scene, const py::kwargs& values) {
    Material material;
    setAttributes("add_material", materialAttributes(), material, values);
    scene->edit().materials.push_back(std::move(material));
    return {scene, scene->get().materials.size() - 1};
}

InstancePart addInstance(const Handle& scene, int mesh, const py::object& material,
                         const py::object& transform, const py::kwargs& values) {
    Instance instance;
    if (mesh < 0 || mesh >= static_cast<int>(scene->get().meshes.size()))
        throw Error(ErrorKind::Usage, fmt::format("mesh: {}; 0 or more and less than {} would be right", mesh,
                                                  scene->get().meshes.size()));
    instance.mesh = mesh;
    if (!material.is_none())
        setAttributes("add_instance", instanceAttributes(), instance,
                      py::kwargs(py::dict(py::arg("material") = material)));
    if (instance.material < -1 || instance.material >= static_cast<int>(scene->get().materials.size()))
        throw Error(ErrorKind::Usage, fmt::format("material: {}; less than {}, or None, would be right",
                                                  instance.material, scene->get().materials.size()));
    if (!transform.is_none()) instance.worldFromObject = mat4Of("transform", transform);
    setAttributes("add_instance", instanceAttributes(), instance, values);
    scene->edit().instances.push_back(std::move(instance));
    return {scene, scene->get().instances.size() - 1};
}

LightPart addLight(const Handle& scene, const std::string& type, const py::kwargs& values) {
    Light light;
    light.type = lightTypeOf(type);
    setAttributes("add_light", lightAttributes(), light, values);
    scene->edit().lights.push_back(std::move(light));
    return {scene, scene->get().lights.size() - 1};
}

void removeLight(const Handle& scene, std::size_t index) {
    LightPart{scene, index}.check();
    std::vector<Light>& lights = scene->edit().lights;
    lights.erase(lights.begin() + static_cast<std::ptrdiff_t>(index));
    if (!scene->movement) return;
    auto movement = std::make_shared<Movement>(*scene->movement);
    std::erase_if(movement->animation.lights, [&](const auto& hung) { return hung.index == index; });
    for (auto& hung : movement->animation.lights)
        if (hung.index > index) --hung.index;
    scene->movement = std::move(movement);
}

Handle copyOf(const Handle& scene) {
    auto copy = std::make_shared<SceneHandle>(scene->get());
    copy->movement = scene->movement;
    return copy;
}

py::tuple clips(const SceneHandle& scene) {
    if (!scene.movement) return py::tuple();
    return py::tuple(py::cast(scene.movement->animation.clips));
}

void pose(const Handle& scene, const py::object& clip, float time) {
    if (!scene->movement)
        throw Error(ErrorKind::Usage,
                    "clip: nothing moves in this scene; one of a glTF file with clips would be right");
    if (!std::isfinite(time)) throw Error(ErrorKind::Usage, "time: is not finite; seconds would be right");
    const io::SceneAnimation& animation = scene->movement->animation;
    const std::size_t number = py::isinstance<io::AnimationClip>(clip)
                                   ? io::clipNumber(animation, clip.cast<const io::AnimationClip&>().name)
                                   : io::clipNumber(animation, py::str(clip));
    const io::NodePoses poses = io::posesAt(animation, number, time);
    io::poseScene(animation, poses, scene->movement->rest, scene->edit());
    for (const io::DeformedMesh& moving : animation.meshes) {
        Mesh mesh = scene->get().meshes[moving.mesh];
        if (io::deform(moving, poses, mesh)) scene->editGeometry().meshes[moving.mesh] = std::move(mesh);
    }
}

void addCamera(const Handle& scene, const Camera& camera) {
    checkCamera(camera);
    scene->edit().cameras.push_back(camera);
}

// A picture (height, width, 3), or a file or builtin that io reads; None: no environment.
void setEnvironment(const Handle& scene, const py::object& picture, float rotation, float strength) {
    if (picture.is_none()) {
        scene->edit().environment = {};
    } else if (!isPath(picture)) {
        const Image image = imageOf("picture", picture);
        if (image.width != 2 * image.height)
            throw Error(ErrorKind::Usage,
                        fmt::format("picture: {}x{} pixels; twice as wide as high would be right",
                                    image.width, image.height));
        auto kept = std::make_shared<EnvironmentImage>();
        kept->width = image.width;
        kept->height = image.height;
        for (const glm::vec4& pixel : image.pixels)
            kept->radiance.emplace_back(glm::max(glm::vec3(pixel), 0.0f));
        scene->edit().environment = {"", std::move(kept), rotation, strength};
    } else {
        const std::string path = pathOf(picture);
        io::LoadedEnvironment loaded = unlocked([&] { return io::loadEnvironment(path); });
        io::useEnvironment(scene->edit(), std::move(loaded), rotation, strength);
    }
}

py::object bounds(const SceneHandle& scene) {
    const Aabb box = scene.get().bounds();
    if (box.empty()) return py::none();
    return py::make_tuple(tupleOf(box.min), tupleOf(box.max));
}

std::string represent(const SceneHandle& scene) {
    const Scene& s = scene.get();
    return fmt::format("<conelight.Scene '{}': {} triangles, {} instances, {} materials, {} lights>", s.name,
                       s.triangleCount(), s.instances.size(), s.materials.size(), s.lights.size());
}

void bindParts(py::class_<SceneHandle, Handle>& type) {
    type.def("add_mesh", &addMesh, py::arg("positions"), py::arg("indices"),
             "Triangles: positions (N, 3), metres; indices (M, 3), counter-clockwise from the front.\n\n"
             "By name: normals (N, 3), uvs (N, 2), tangents (N, 4), colors (N, 4), name. Drawn once an "
             "instance\n"
             "places it.")
        .def("add_texture", &addTexture, py::arg("pixels"),
             "A picture (height, width, 3 or 4) uint8; returns its index for materials.\n\n"
             "By name: srgb (True for colours, False for normals and roughness), wrap 'repeat', 'clamp' or\n"
             "'mirror', filter 'linear' or 'nearest', name.")
        .def("add_material", &addMaterial, "A material; the attributes of Material by name.")
        .def("add_instance", &addInstance, py::arg("mesh"), py::arg("material") = py::none(),
             py::arg("transform") = py::none(),
             "Places a mesh: transform (4, 4), world from object; other attributes of Instance by name.")
        .def("add_light", &addLight, py::arg("type"),
             "A light: 'point', 'spot', 'directional', 'rect', 'disk' or 'sphere'; the attributes of Light "
             "by name.")
        .def("remove_light", &removeLight, py::arg("light"), "Lights behind it move up by one.")
        .def("add_camera", &addCamera, py::arg("camera"),
             "The first one is what render shows without a camera.")
        .def_property_readonly(
            "cameras", [](const Handle& s) { return py::tuple(py::cast(s->get().cameras)); },
            "Copies of all.");
    bindList<Mesh, &Scene::meshes>(type, "meshes");
    bindList<Material, &Scene::materials>(type, "materials");
    bindList<Instance, &Scene::instances>(type, "instances");
    bindList<Light, &Scene::lights>(type, "lights");
}

void bindFacts(py::class_<SceneHandle, Handle>& type) {
    type.def_property(
            "name", [](const SceneHandle& s) { return s.get().name; },
            [](SceneHandle& s, const std::string& name) { s.edit().name = name; }, "Text.")
        .def_property(
            "sky", [](const SceneHandle& s) { return tupleOf(s.get().sky); },
            [](SceneHandle& s, const py::object& value) { s.edit().sky = vec3Of("sky", value); },
            "Constant radiance of the surroundings, W/(sr m^2): (3,).")
        .def_property_readonly("clips", &clips,
                               "What moves in the glTF file that the scene is from: Clips, or none.")
        .def("pose", &pose, py::arg("clip"), py::arg("time"),
             "Puts instances, lights and cameras where a clip has them at a time, seconds.\n\n"
             "clip: a Clip, its name or its number. What was moved by hand and hangs on the file's nodes "
             "goes back\n"
             "to them.")
        .def_property_readonly(
            "notes", [](const SceneHandle& s) { return s.get().notes; },
            "What was left out or added when the scene was loaded.")
        .def_property_readonly("bounds", &bounds, "(min, max) in metres, or None when there is nothing.")
        .def_property_readonly(
            "triangle_count", [](const SceneHandle& s) { return s.get().triangleCount(); },
            "Over visible instances.");
}

}  // namespace

void bindScene(py::module_& module) {
    py::class_<io::AnimationClip>(module, "Clip", "A movement of a scene: node tracks of a glTF animation.")
        .def_readonly("name", &io::AnimationClip::name, "Text.")
        .def_readonly("duration", &io::AnimationClip::duration, "Seconds, time of the last key.")
        .def("__repr__", [](const io::AnimationClip& clip) {
            return fmt::format("<conelight.Clip '{}': {} s>", clip.name, clip.duration);
        });
    py::class_<SceneHandle, Handle> type(module, "Scene",
                                         "Meshes, materials, instances, lights, surroundings. Metres, y up, "
                                         "linear Rec.709, radiometric units.");
    type.def(py::init([] { return std::make_shared<SceneHandle>(); }));
    bindParts(type);
    bindFacts(type);
    type.def_static(
            "load", &load, py::arg("path"), py::kw_only(), py::arg("complete") = true,
            py::arg("allow_outside") = false,
            "A scene from a file (glTF, OBJ, ...) or 'builtin:NAME'.\n\n"
            "complete: what is missing to be seen, camera or light, is added; notes say so.\n"
            "allow_outside: the file may name files outside its folder; only for files that are trusted.")
        .def(
            "save",
            [](const Handle& s, const std::filesystem::path& path) { return io::writeGltf(path, s->get()); },
            py::arg("path"), "Writes .glb or .gltf; returns lines that say what other programs will not see.")
        .def(
            "complete", [](const Handle& s) { completeScene(s->edit()); },
            "Adds a camera, and light where there is none.")
        .def(
            "validate", [](const SceneHandle& s) { s.get().validate(); },
            "Raises Error for what breaks a rule.")
        .def(
            "info", [](const SceneHandle& s) { return io::describeScene(s.get()); }, "The scene in words.")
        .def(
            "settings",
            [](const SceneHandle& s, const std::string& mode) {
                return program::startSettings(s.get(), mode);
            },
            py::arg("mode") = "",
            "Settings that the scene starts with: the defaults, and what its file asks for.")
        .def("copy", &copyOf, "A scene of its own, the same.")
        .def("__copy__", &copyOf)
        .def("__deepcopy__", [](const Handle& s, const py::dict&) { return copyOf(s); })
        .def("set_environment", &setEnvironment, py::arg("picture"), py::kw_only(),
             py::arg("rotation") = 0.0f, py::arg("strength") = 1.0f,
             "Surroundings: a latitude-longitude picture (H, 2 H, 3) of radiance, a file, 'builtin:sky', or "
             "None.")
        .def(
            "frame_camera", [](const SceneHandle& s) { return frameCamera(s.get().bounds()); },
            "A camera that sees the whole scene.")
        .def("__repr__", &represent);
    module.def(
        "builtin_scenes",
        [] {
            std::vector<std::string> names;
            for (const io::GeneratedSceneInfo& info : io::generatedScenes())
                names.push_back("builtin:" + std::string(info.name));
            return names;
        },
        "Names of generated scenes, for Scene.load.");
}

}  // namespace conelight::python
