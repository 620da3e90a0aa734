// SPDX-License-Identifier: MIT
// Ways of cameras through key frames.
#include <fmt/core.h>
#include <pybind11/stl.h>

#include "arrays.h"
#include "bindings.h"
#include "camera_axes.h"
#include "conelight/error.h"
#include "session/camera_path.h"

namespace conelight::python {
namespace {

using program::CameraPath;

CameraPath pathOf(const std::vector<std::pair<double, Camera>>& keys) {
    CameraPath path;
    for (const auto& [seconds, camera] : keys) {
        checkCamera(camera);
        path.add(seconds, camera);
    }
    return path;
}

const CameraPath& withKeys(const CameraPath& path) {
    if (path.empty()) throw Error(ErrorKind::Usage, "the path has no keys; at least one would be right");
    return path;
}

std::vector<Camera> frames(const CameraPath& path, int count) {
    if (count < 1 || count > 1 << 20)
        throw Error(ErrorKind::Usage,
                    fmt::format("count: {} is out of range; 1 to {} would be right", count, 1 << 20));
    std::vector<Camera> cameras;
    for (int i = 0; i < count; ++i) cameras.push_back(withKeys(path).frame(i, count));
    return cameras;
}

}  // namespace

void bindPath(py::module_& module) {
    py::class_<CameraPath>(
        module, "CameraPath",
        "A camera's way through key frames, as the viewer's and that of `render --path`: smooth "
        "between them.")
        .def(py::init(&pathOf), py::arg("keys"),
             "keys: pairs of a time in seconds and a Camera, in any order.")
        .def_static(
            "load", [](const std::string& file) { return program::readCameraPath(file); }, py::arg("path"),
            "A path from a file, docs/reference/camera_path.md.")
        .def(
            "save",
            [](const CameraPath& path, const std::string& file, bool overwrite) {
                program::writeCameraPath(file, withKeys(path), overwrite);
            },
            py::arg("path"), py::kw_only(), py::arg("overwrite") = false, "Writes the keys to a file.")
        .def_property_readonly("start", &CameraPath::start, "Time of the first key, seconds.")
        .def_property_readonly("end", &CameraPath::end, "Time of the last key, seconds.")
        .def_property_readonly(
            "keys",
            [](const CameraPath& path) {
                std::vector<std::pair<double, Camera>> keys;
                for (const program::PathKey& key : path.keys()) keys.emplace_back(key.seconds, key.camera);
                return keys;
            },
            "Pairs of a time in seconds and a Camera, in order.")
        .def(
            "at", [](const CameraPath& path, double seconds) { return withKeys(path).at(seconds); },
            py::arg("seconds"),
            "The camera at a time; before the first key the first, behind the last the last.")
        .def("frames", &frames, py::arg("count"), "Cameras at equal steps from start to end, both included.");
}

}  // namespace conelight::python
