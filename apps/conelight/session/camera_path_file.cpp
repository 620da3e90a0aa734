// SPDX-License-Identifier: MIT
// Camera paths as JSON: docs/reference/camera_path.md.
#include <fmt/core.h>

#include <cmath>

#include "conelight/error.h"
#include "io/files.h"
#include "io/json_file.h"
#include "session/camera_path.h"
#include "session/lens_range.h"

namespace conelight::program {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kDegree = 3.14159265358979323846 / 180.0;
constexpr const char* kPathKind = "camera path";

std::string jsonText(const glm::vec3& v) { return fmt::format("[{:.9g}, {:.9g}, {:.9g}]", v.x, v.y, v.z); }

double number(const io::JsonFile& file, const Json& value, const std::string& pointer,
              const std::string& what, double low, double high) {
    const double given = value.is_number() ? value.get<double>() : std::nan("");
    if (given >= low && given <= high) return given;
    file.fail(pointer, fmt::format("{}: {} is not usable; a number from {:g} to {:g} would be right", what,
                                   io::oneLine(value.dump(), 40), low, high));
}

glm::vec3 vector(const io::JsonFile& file, const Json& value, const std::string& pointer,
                 const std::string& what) {
    if (!value.is_array() || value.size() != 3)
        file.fail(pointer, fmt::format("{}: {} is not usable; [x, y, z] would be right", what,
                                       io::oneLine(value.dump(), 40)));
    glm::vec3 v;
    for (int c = 0; c < 3; ++c)
        v[c] = static_cast<float>(number(file, value[static_cast<std::size_t>(c)],
                                         pointer + "/" + std::to_string(c), what, -1e9, 1e9));
    return v;
}

PathKey keyOf(const io::JsonFile& file, const Json& json, const std::string& pointer, std::size_t index,
              double seconds) {
    const std::string name = fmt::format("key {}", index);
    if (!json.is_object())
        file.fail(pointer, name + " is no object; {\"eye\": ..., \"target\": ...} would be right");
    PathKey key;
    key.seconds = seconds;
    for (const auto& [field, value] : json.items()) {
        const std::string at = pointer + "/" + field, what = name + ", " + field;
        if (field == "time")
            key.seconds = number(file, value, at, what, 0, 1e6);
        else if (field == "eye")
            key.camera.eye = vector(file, value, at, what);
        else if (field == "target")
            key.camera.target = vector(file, value, at, what);
        else if (field == "up")
            key.camera.up = vector(file, value, at, what);
        else if (field == "fov")
            key.camera.fovY = static_cast<float>(number(file, value, at, what, 1, 170) * kDegree);
        else if (field == "near")
            key.camera.zNear = static_cast<float>(number(file, value, at, what, 1e-6, 1e6));
        else if (field == "far")
            key.camera.zFar = static_cast<float>(number(file, value, at, what, 1e-6, 1e9));
        else if (field == "lens")
            key.camera.lensDiameter = static_cast<float>(number(file, value, at, what, 0, kWidestLens));
        else if (field == "focus")
            key.camera.focusDistance = static_cast<float>(number(file, value, at, what, 0, 1e6));
        else if (field == "orthographic")
            key.camera.orthographicHeight =
                static_cast<float>(number(file, value, at, what, 0, kTallestView));
        else if (field == "hour")
            key.hour = number(file, value, at, what, 0, 48);
        else
            file.fail(at, fmt::format("{} has no field '{}'; time, eye, target, up, fov, near, far, lens, "
                                      "focus, orthographic or hour would be right",
                                      name, io::oneLine(field, 40)));
    }
    for (const char* needed : {"eye", "target"})
        if (!json.contains(needed))
            file.fail(pointer, fmt::format("{} has no {}; it is needed", name, needed));
    if (!(glm::distance(key.camera.eye, key.camera.target) > 1e-9f))
        file.fail(pointer, name + ": eye and target are the same point; another one would be right");
    if (!(glm::length(key.camera.up) > 0)) file.fail(pointer + "/up", name + ": up has no length");
    if (!(key.camera.zNear < key.camera.zFar)) file.fail(pointer, name + ": near is not below far");
    return key;
}

// Nothing for a pinhole in perspective.
std::string lensText(const Camera& camera) {
    std::string text;
    if (camera.lensDiameter > 0)
        text +=
            fmt::format(", \"lens\": {:.9g}, \"focus\": {:.9g}", camera.lensDiameter, camera.focusDistance);
    if (camera.isOrthographic()) text += fmt::format(", \"orthographic\": {:.9g}", camera.orthographicHeight);
    return text;
}

}  // namespace

CameraPath readCameraPath(const std::string& name) {
    const io::JsonFile file(name);
    const Json& root = file.root();
    if (!root.is_object() || root.value("conelight", Json()) != kPathKind)
        file.fail("/conelight", "is no camera path, which says \"conelight\": \"camera path\"");
    for (const auto& [field, value] : root.items())
        if (field != "conelight" && field != "keys")
            file.fail("/" + field,
                      fmt::format("there is no field '{}'; keys would be right", io::oneLine(field, 40)));
    const Json keys = root.value("keys", Json());
    if (!keys.is_array() || keys.empty())
        file.fail("/keys", "keys: a list of at least one key would be right");
    CameraPath path;
    for (std::size_t i = 0; i < keys.size(); ++i) {
        const std::string pointer = "/keys/" + std::to_string(i);
        const PathKey key = keyOf(file, keys[i], pointer, i, i == 0 ? 0 : path.end() + 1);
        if (!path.empty() && !(key.seconds > path.end()))
            file.fail(pointer + "/time",
                      fmt::format("key {}: time {:g} s is not later than the key before, at "
                                  "{:g} s",
                                  i, key.seconds, path.end()));
        path.add(key.seconds, key.camera, key.hour);
    }
    return path;
}

void writeCameraPath(const std::string& name, const CameraPath& path, bool overwrite) {
    io::refuseOverwriting(name, overwrite);
    std::string out = fmt::format("{{\n  \"conelight\": \"{}\",\n  \"keys\": [", kPathKind);
    for (std::size_t i = 0; i < path.keys().size(); ++i) {
        const auto& [seconds, camera, hour] = path.keys()[i];
        out += fmt::format(
            "{}\n    {{\"time\": {}, \"eye\": {}, \"target\": {}, \"up\": {}, \"fov\": {:.10g}, \"near\": "
            "{:.9g}, "
            "\"far\": {:.9g}{}{}}}",
            i == 0 ? "" : ",", seconds, jsonText(camera.eye), jsonText(camera.target), jsonText(camera.up),
            double(camera.fovY) / kDegree, camera.zNear, camera.zFar, lensText(camera),
            hour ? fmt::format(", \"hour\": {}", *hour) : "");
    }
    out += "\n  ]\n}\n";
    io::writeFile(name, {reinterpret_cast<const std::uint8_t*>(out.data()), out.size()});
}

}  // namespace conelight::program
