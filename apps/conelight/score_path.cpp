// SPDX-License-Identifier: MIT
#include "score_path.h"

#include <cmath>
#include <cstdlib>
#include <glm/gtc/matrix_transform.hpp>
#include <set>

#include "conelight/error.h"

namespace conelight::program {
namespace {

[[noreturn]] void badPath(const std::string& text) {
    throw Error(ErrorKind::Usage,
                "--path: '" + text +
                    "' is not usable; orbit=DEGREES, dolly=PART, object=NAME:X,Y,Z, light=NAME:X,Y,Z, "
                    "dim=NAME:PART, clip=NAME or the file of a camera path would be right");
}

// 0 at the first frame, 1 at the last.
float partOf(int index, int count) { return static_cast<float>(index) / static_cast<float>(count - 1); }

}  // namespace

ScorePath::ScorePath(const std::string& text, const std::string& scene, const ViewOptions& view)
    : text_(text) {
    const std::size_t equals = text.find('=');
    const std::string kind = text.substr(0, equals);
    const bool isFile =
        equals == std::string::npos || (text.size() > 5 && text.substr(text.size() - 5) == ".json");
    if (isFile) {
        kind_ = Kind::File;
        keys_ = readCameraPath(text);
        hours_ = hoursOf(keys_, text, scene, view);
        return;
    }
    const std::string value = text.substr(equals + 1);
    if (kind == "object" || kind == "light") {
        takeTravel(kind == "light" ? Kind::Light : Kind::Object, value);
        return;
    }
    if (kind == "dim") {
        takeDimming(value);
        return;
    }
    if (kind == "clip") {
        kind_ = Kind::Clip;
        name_ = value;
        return;
    }
    amount_ = numberIn(value);
    if (kind == "dolly" && amount_ < 1)
        kind_ = Kind::Dolly;
    else if (kind != "orbit")
        badPath(text);
}

// The name of NAME:VALUE; returns the value.
std::string ScorePath::takeName(const std::string& text) {
    const std::size_t colon = text.rfind(':');
    if (colon == std::string::npos) badPath(text_);
    name_ = text.substr(0, colon);
    return text.substr(colon + 1);
}

void ScorePath::takeTravel(Kind kind, const std::string& value) {
    kind_ = kind;
    travel_ = parseVec3("--path", takeName(value));
}

void ScorePath::takeDimming(const std::string& value) {
    kind_ = Kind::Dim;
    amount_ = numberIn(takeName(value));
    if (amount_ > 1) badPath(text_);
}

float ScorePath::numberIn(const std::string& value) const {
    char* end = nullptr;
    const float number = std::strtof(value.c_str(), &end);
    if (value.empty() || *end != '\0' || !std::isfinite(number)) badPath(text_);
    return number;
}

Camera ScorePath::cameraAt(const Camera& start, int index, int count) const {
    Camera camera = start;
    const glm::vec3 arm = camera.eye - camera.target;
    if (kind_ == Kind::File) camera = keys_.frame(index, count);
    if (kind_ == Kind::Orbit) {
        const glm::mat4 turn = glm::rotate(glm::mat4(1), glm::radians(amount_ * partOf(index, count)),
                                           glm::normalize(camera.up));
        camera.eye = camera.target + glm::vec3(turn * glm::vec4(arm, 0));
    }
    if (kind_ == Kind::Dolly) camera.eye = camera.target + (1 - amount_ * partOf(index, count)) * arm;
    return camera;
}

Scene ScorePath::sceneAt(const Scene& scene, int index, int count) const {
    if (hours_) return hours_->at(scene, *keys_.hourAt(keys_.frameSeconds(index, count)));
    Scene moved = scene;
    if (kind_ == Kind::Clip) {
        const std::size_t clip = io::clipNumber(animation_, name_);
        const io::NodePoses poses =
            io::posesAt(animation_, clip, partOf(index, count) * animation_.clips[clip].duration);
        io::poseScene(animation_, poses, scene, moved);
        for (const io::DeformedMesh& mesh : animation_.meshes)
            io::deform(mesh, poses, moved.meshes[mesh.mesh]);
    }
    const glm::vec3 travelled = partOf(index, count) * travel_;
    if (kind_ == Kind::Object) moveObject(moved, travelled);
    if (kind_ == Kind::Light) moveLight(moved, travelled);
    if (kind_ == Kind::Dim) dim(moved, index % 2 == 0 ? 1 : 1 - amount_);
    return moved;
}

void ScorePath::moveObject(Scene& scene, const glm::vec3& by) const {
    bool found = false;
    for (Instance& instance : scene.instances) {
        if (instance.name != name_) continue;
        instance.worldFromObject = glm::translate(glm::mat4(1), by) * instance.worldFromObject;
        found = true;
    }
    if (!found)
        throw Error(ErrorKind::Usage,
                    "--path: the scene has no object '" + name_ +
                        "'; a name that `conelight info SCENE --objects` lists would be right");
}

// A light, or a material of an object that emits.
void ScorePath::dim(Scene& scene, float to) const {
    bool found = false;
    for (Light& light : scene.lights) {
        if (light.name != name_) continue;
        light.intensity *= to;
        found = true;
    }
    std::set<std::size_t> materials;
    for (const Instance& instance : scene.instances)
        if (instance.name == name_ && instance.material >= 0)
            materials.insert(static_cast<std::size_t>(instance.material));
    for (const std::size_t material : materials) {
        glm::vec3& emission = scene.materials[material].emission;
        found = found || emission != glm::vec3(0);
        emission *= to;
    }
    if (!found)
        throw Error(ErrorKind::Usage,
                    "--path: the scene has no light and nothing that emits '" + name_ +
                        "'; a name that `conelight info SCENE --objects` lists would be right");
}

void ScorePath::moveLight(Scene& scene, const glm::vec3& by) const {
    bool found = false;
    for (Light& light : scene.lights) {
        if (light.name != name_) continue;
        light.position += by;
        found = true;
    }
    if (!found)
        throw Error(ErrorKind::Usage, "--path: the scene has no light '" + name_ +
                                          "'; a name that `conelight info SCENE` lists would be right");
}

}  // namespace conelight::program
