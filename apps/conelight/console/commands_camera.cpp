// SPDX-License-Identifier: MIT
// The camera: `camera` with a name, a number or one of its words.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "conelight/error.h"
#include "console/console.h"
#include "console/names.h"
#include "session/lens_range.h"
#include "session/projection.h"
#include "session/usage.h"

namespace conelight::program {
namespace {

std::string exactText(const glm::vec3& v) { return fmt::format("{:.9g} {:.9g} {:.9g}", v.x, v.y, v.z); }

void printCamera(const CommandContext& context, const Camera& camera) {
    context.print(fmt::format("camera {}", camera.name.empty() ? "(free)" : camera.name));
    context.print("  eye    " + exactText(camera.eye) + " m");
    context.print("  target " + exactText(camera.target) + " m");
    context.print("  up     " + exactText(camera.up));
    context.print(fmt::format("  fov    {:.6g} deg", glm::degrees(camera.fovY)));
    if (camera.isOrthographic())
        context.print(fmt::format("  orthographic, {:.6g} m high", camera.orthographicHeight));
    if (camera.lensDiameter > 0)
        context.print(
            fmt::format("  lens   {:.6g} m, focus at {:.6g} m", camera.lensDiameter, camera.focus()));
}

// `count` numbers behind the first word.
std::vector<double> numbers(const CommandContext& context, std::size_t count, const char* usageText) {
    if (context.count() != count + 1)
        usage(fmt::format("camera {}: takes {} number{}, got {}; camera {} {} would be right",
                          context.words[0], count, count == 1 ? "" : "s", context.count() - 1,
                          context.words[0], usageText));
    std::vector<double> values;
    for (std::size_t i = 0; i < count; ++i)
        values.push_back(numberFrom("camera " + context.words[0], context.words[i + 1]));
    return values;
}

glm::vec3 vector(const std::vector<double>& v) {
    return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

void jump(const CommandContext& context, Camera camera, const std::string& label) {
    if (!(glm::length(camera.target - camera.eye) > 1e-9f))
        usage("camera: eye and target are the same point; another one would be right");
    camera.name.clear();
    context.session.jumpCamera(camera, label);
}

// Round the target: degrees to the right, then upward, short of the poles.
void orbit(const CommandContext& context, Camera camera) {
    std::vector<double> v =
        context.count() == 2 ? numbers(context, 1, "DEG [DEG]") : numbers(context, 2, "DEG [DEG]");
    v.resize(2, 0.0);
    const glm::vec3 up = glm::normalize(camera.up);
    glm::vec3 offset = camera.eye - camera.target;
    const float distance = glm::length(offset);
    offset = glm::vec3(glm::rotate(glm::mat4(1), glm::radians(static_cast<float>(v[0])), up) *
                       glm::vec4(offset, 0));
    const float elevation = std::asin(std::clamp(glm::dot(offset, up) / distance, -1.0f, 1.0f));
    // 89 degrees: as far as the original's camera looks up or down.
    const float most = glm::radians(89.0f);
    const float wanted = std::clamp(elevation + glm::radians(static_cast<float>(v[1])), -most, most);
    const glm::vec3 side = glm::cross(up, offset);
    if (glm::length(side) > 1e-6f * distance)
        offset = glm::vec3(glm::rotate(glm::mat4(1), elevation - wanted, glm::normalize(side)) *
                           glm::vec4(offset, 0));
    camera.eye = camera.target + offset;
    jump(context, camera, "camera orbit");
}

void list(const CommandContext& context) {
    const std::vector<Camera>& cameras = context.session.scene().cameras;
    for (std::size_t i = 0; i < cameras.size(); ++i)
        context.print(fmt::format("{:3} {:<20} eye {}  target {}  {}", i, cameras[i].name,
                                  exactText(cameras[i].eye), exactText(cameras[i].target),
                                  projectionText(cameras[i])));
}

void add(const CommandContext& context) {
    if (context.count() != 2) usage("camera add: takes a name; camera add NAME would be right");
    Camera camera = context.session.camera();
    camera.name = context.words[1];
    std::vector<Camera> cameras = context.session.scene().cameras;
    const auto same = std::find_if(cameras.begin(), cameras.end(),
                                   [&](const Camera& one) { return one.name == camera.name; });
    if (same != cameras.end())
        *same = camera;
    else
        cameras.push_back(camera);
    context.session.setCameras(cameras, "camera add " + camera.name);
}

// Object in the middle of the picture, seen from the present side.
void frame(const CommandContext& context, Camera camera) {
    if (context.count() != 2) usage("camera frame: takes an object; camera frame OBJECT would be right");
    requireName("camera frame", "object", objectNames(context.session), context.words[1]);
    const Scene& scene = context.session.scene();
    Aabb bounds;
    for (const std::size_t index : objectsNamed(context.session, context.words[1])) {
        const Instance& instance = scene.instances[index];
        if (instance.mesh < 0) continue;
        bounds.grow(scene.meshes[static_cast<std::size_t>(instance.mesh)].bounds().transformed(
            instance.worldFromObject));
    }
    if (bounds.empty()) usage("camera frame: the object has no surface");
    const float radius = std::max(0.5f * glm::length(bounds.extent()), 1e-4f);
    const glm::vec3 back = glm::normalize(camera.eye - camera.target);
    camera.target = bounds.center();
    camera.eye = camera.target + back * (1.02f * radius / std::sin(0.5f * camera.fovY));
    if (camera.isOrthographic()) camera.orthographicHeight = 1.02f * 2 * radius;
    jump(context, camera, "camera frame");
}

// Its diameter, or the distance of the plane in focus.
void lens(const CommandContext& context, Camera camera) {
    const std::string& word = context.words[0];
    const bool isFocus = word == "focus";
    const double most = isFocus ? 1e6 : static_cast<double>(kWidestLens);
    const double value = numbers(context, 1, "M")[0];
    if (!(value >= 0 && value <= most))
        usage(fmt::format("camera {}: '{}' is not usable; a number from 0 to {:g} m would be right", word,
                          context.words[1], most));
    (isFocus ? camera.focusDistance : camera.lensDiameter) = static_cast<float>(value);
    jump(context, camera, "camera " + word);
}

// Parallel rays and their height, m; without a number the other kind of projection.
void orthographic(const CommandContext& context, Camera camera) {
    if (context.count() == 1) {
        switchProjection(camera);
        return jump(context, camera, camera.isOrthographic() ? "orthographic" : "perspective");
    }
    const double height = numbers(context, 1, "M")[0];
    if (!(height >= 0 && height <= static_cast<double>(kTallestView)))
        usage(fmt::format("camera orthographic: '{}' is not usable; a number from 0 to {:g} m would be right",
                          context.words[1], kTallestView));
    camera.orthographicHeight = static_cast<float>(height);
    jump(context, camera, "camera orthographic");
}

void camera(const CommandContext& context) {
    Session& session = context.session;
    Camera camera = session.camera();
    if (context.count() == 0) return printCamera(context, camera);
    const std::string& word = context.words[0];
    if (word == "list" && context.count() == 1) return list(context);
    if (word == "add") return add(context);
    if (word == "orbit") return orbit(context, camera);
    if (word == "frame") return frame(context, camera);
    if (word == "eye" || word == "target" || word == "up") {
        const glm::vec3 v = vector(numbers(context, 3, "X Y Z"));
        if (word == "up" && !(glm::length(v) > 0)) usage("camera up: has no length");
        (word == "eye"      ? camera.eye
         : word == "target" ? camera.target
                            : camera.up) = word == "up" ? glm::normalize(v) : v;
        return jump(context, camera, "camera " + word);
    }
    if (word == "fov") {
        const double fov = numbers(context, 1, "DEG")[0];
        if (!(fov >= 1 && fov <= 170))
            usage(fmt::format("camera fov: '{}' is not usable; a number from 1 to 170 deg would be right",
                              context.words[1]));
        camera.fovY = static_cast<float>(fov * 3.14159265358979 / 180.0);
        return jump(context, camera, "camera fov");
    }
    if (word == "lens" || word == "focus") return lens(context, camera);
    if (word == "orthographic") return orthographic(context, camera);
    if (context.count() > 1)
        usage(
            fmt::format("camera: '{}' takes no arguments; list, eye, target, up, fov, lens, focus, "
                        "orthographic, orbit, frame, add or a camera's name would be right",
                        word));
    requireName("camera", "camera", cameraNames(session), word);
    session.jumpCamera(session.scene().cameras[camerasNamed(session, word).front()], "camera " + word);
}

}  // namespace

CommandGroup cameraCommands() {
    Command command;
    command.name = "camera";
    command.arguments = {{"NAME", ArgumentKind::Camera, true}, {"VALUE", ArgumentKind::Text, true, true}};
    command.help = "look through a camera of the scene, move the camera, or print where it is";
    command.details =
        "camera                  where it is\n"
        "camera list             cameras of the scene\n"
        "camera NAME|NUMBER      look through one of them\n"
        "camera eye X Y Z        move it, m\n"
        "camera target X Y Z     look at a point, m\n"
        "camera up X Y Z         what is up\n"
        "camera fov DEG          vertical field of view, 1 to 170 degrees\n"
        "camera lens M           diameter of its lens, m: what is out of focus is blurred; 0: a pinhole\n"
        "camera focus M          distance of the plane in focus, m; 0: through the target\n"
        "camera orthographic [M] parallel rays that show M metres from top to bottom; 0: perspective; "
        "without M one for the other\n"
        "camera orbit DEG [DEG]  round the target: to the right, and upward\n"
        "camera frame OBJECT     an object in the middle, seen from this side\n"
        "camera add NAME         keep the view as a camera of the scene";
    command.run = camera;
    return {"Camera", {command, pathCommand(), clipCommand()}};
}

}  // namespace conelight::program
