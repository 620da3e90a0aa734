// SPDX-License-Identifier: MIT
#include "session/addition.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <glm/gtc/constants.hpp>
#include <memory>
#include <type_traits>
#include <utility>

#include "conelight/error.h"
#include "conelight/scene_fields.h"
#include "io/generated_shapes.h"
#include "session/projection.h"
#include "session/rename.h"

namespace conelight::program {
namespace {

using io::shapes::Patch;

constexpr int kAround = 64;  // pieces of a round shape, by eye

// Of 1 m, on y = 0.
Mesh meshOf(const std::string& kind) {
    namespace shapes = io::shapes;
    Mesh mesh;
    mesh.name = kind;
    if (kind == "plane") shapes::appendQuad(mesh, {-0.5f, 0, 0.5f}, {1, 0, 0}, {0, 0, -1});
    if (kind == "box") shapes::appendBox(mesh, {{-0.5f, 0, -0.5f}, {0.5f, 1, 0.5f}});
    if (kind == "sphere")
        shapes::appendPatch(mesh, shapes::uvSphere({0, 0.5f, 0}, glm::vec3(0.5f), kAround, kAround / 2));
    if (kind == "cylinder") {
        const std::vector<shapes::Curve> profile = {shapes::line({0, 0}, {0.5f, 0}),
                                                    shapes::line({0.5f, 0}, {0.5f, 1}),
                                                    shapes::line({0.5f, 1}, {0, 1})};
        for (const Patch& patch : shapes::lathe(profile, kAround, 0.5f)) shapes::appendPatch(mesh, patch);
    }
    if (kind == "torus") {
        constexpr float kTube = 0.14f;
        const shapes::Curve tube = shapes::arc({0.5f - kTube, kTube}, glm::vec2(kTube), -glm::pi<float>(),
                                               glm::pi<float>(), kAround / 2);
        for (const Patch& patch : shapes::lathe({tube}, kAround, 0.5f)) shapes::appendPatch(mesh, patch);
    }
    return mesh;
}

float roundSize(float size) {
    const float power = std::pow(10.0f, std::floor(std::log10(std::max(size, 1e-6f))));
    const float digits = size / power;
    return power * (digits < 1.5f ? 1.0f : digits < 3.5f ? 2.0f : digits < 7.5f ? 5.0f : 10.0f);
}

Aabb boundsOf(const Scene& part) {
    Aabb box = part.bounds();
    if (box.empty())
        for (const Light& light : part.lights) box.grow(light.position);
    return box.empty() ? Aabb{glm::vec3(0), glm::vec3(0)} : box;
}

template <class T>
std::vector<std::string> givenNames(const std::vector<T>& things) {
    std::vector<std::string> names;
    for (const T& one : things) names.push_back(one.name);
    return names;
}

template <class T>
void nameApart(std::vector<T>& added, const std::vector<T>& others) {
    FreeNames free(givenNames(others));
    for (T& one : added)
        if (!one.name.empty()) one.name = free.takeOwn(one.name);
}

// Indices of `part` as they are behind those of `scene`.
void renumber(Scene& part, const Scene& scene) {
    const auto shift = [](int& index, std::size_t by) {
        if (index >= 0) index += static_cast<int>(by);
    };
    for (Material& m : part.materials)
        visitFields(
            [&](const char*, auto& value) {
                if constexpr (std::is_same_v<decltype(value), TextureRef&>)
                    shift(value.texture, scene.textures.size());
            },
            m);
    for (Instance& instance : part.instances) {
        shift(instance.mesh, scene.meshes.size());
        shift(instance.material, scene.materials.size());
        shift(instance.group, scene.groups.size());
    }
    for (Light& light : part.lights) shift(light.group, scene.groups.size());
    for (Group& group : part.groups) shift(group.parent, scene.groups.size());
}

}  // namespace

const std::vector<std::string>& shapeKinds() {
    static const std::vector<std::string> kKinds = {"plane", "box", "sphere", "cylinder", "torus"};
    return kKinds;
}

Scene shapeOf(const std::string& kind, float size) {
    Scene scene;
    scene.meshes.push_back(meshOf(kind));
    for (glm::vec3& position : scene.meshes[0].positions) position *= size;
    scene.materials.emplace_back();
    scene.materials[0].name = kind;
    scene.materials[0].doubleSided = kind == "plane";
    scene.instances.push_back({kind, 0, 0});
    return scene;
}

AddedPlace placeInView(const Session& session, Picker& picker) {
    const Camera& camera = session.camera();
    const glm::vec3 view(cameraAxes(camera).forward);
    const float reach = glm::length(camera.target - camera.eye);
    const auto sizeAt = [&](float distance) { return roundSize(0.35f * camera.heightAt(distance)); };
    const std::optional<Pick> seen = picker.along(session, camera.eye, view, camera.zNear);
    if (!seen) return {camera.target, sizeAt(reach)};
    const float size = sizeAt(seen->distance);
    constexpr float kLevel = 0.7f;  // of the normal's height
    if (seen->normal.y > kLevel) return {seen->position, size};
    // Before a wall, on what is below.
    const glm::vec3 before = seen->position + 0.75f * size * seen->normal;
    const std::optional<Pick> below = picker.along(session, before, {0, -1, 0});
    return {below ? below->position : before, size};
}

void addToScene(Session& session, Scene part, const glm::vec3& foot, const std::string& label) {
    const Scene& scene = session.scene();
    const Aabb box = boundsOf(part);
    const glm::vec3 move = foot - glm::vec3(box.center().x, box.min.y, box.center().z);
    for (Instance& instance : part.instances) instance.worldFromObject[3] += glm::vec4(move, 0);
    for (Light& light : part.lights) light.position += move;
    nameApart(part.instances, scene.instances);
    nameApart(part.materials, scene.materials);
    nameApart(part.lights, scene.lights);
    renumber(part, scene);
    std::vector<Selection> made;
    for (std::size_t i = 0; i < part.lights.size(); ++i)
        made.push_back({SelectionKind::Light, scene.lights.size() + i});
    for (std::size_t i = 0; i < part.instances.size(); ++i)
        made.push_back({SelectionKind::Instance, scene.instances.size() + i});
    SceneEdits edits;
    edits.added = std::make_shared<Scene>(std::move(part));
    session.edit(edits, label);
    session.selectAll(made);
}

Scene readPart(const std::string& file, const OpenHow& how, const io::LoadOptions& options) {
    io::LoadOptions load = options;
    load.allowOutside = how.allowOutside;
    Scene part = io::loadScene(file, load);
    if (part.instances.empty() && part.lights.empty())
        throw Error(ErrorKind::Usage, "import: " + file + ": holds no object and no light");
    if (part.instances.size() + part.lights.size() == 1) return part;
    for (Group& group : part.groups) ++group.parent;
    for (Instance& instance : part.instances) ++instance.group;
    for (Light& light : part.lights) ++light.group;
    part.groups.insert(part.groups.begin(), {std::filesystem::path(file).stem().string(), -1});
    return part;
}

std::vector<std::string> addImported(Session& session, Picker& picker, Scene part, const std::string& file) {
    std::vector<std::string> lines = part.notes;
    const std::size_t objects = part.instances.size(), lights = part.lights.size();
    addToScene(session, std::move(part), placeInView(session, picker).foot, "import " + file);
    lines.push_back(fmt::format("imported {}: {} object{}, {} light{}", file, objects,
                                objects == 1 ? "" : "s", lights, lights == 1 ? "" : "s"));
    return lines;
}

}  // namespace conelight::program
