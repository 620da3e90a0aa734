// SPDX-License-Identifier: MIT
// Cameras: by eye and target, by OpenCV's matrices, and points of the world behind the pixels of a depth picture.
#include <fmt/core.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>

#include "arrays.h"
#include "bindings.h"
#include "camera_axes.h"
#include "conelight/error.h"
#include "opencv_camera.h"

namespace conelight::python {

namespace {

using Matrix = py::array_t<double, py::array::c_style | py::array::forcecast>;

template <class Result>
Result matrixOf(const char* what, const py::handle& value) {
    floatsOf(what, value);
    const Matrix rows = Matrix::ensure(value);
    if (rows.ndim() != 2 || rows.shape(0) != 3 || rows.shape(1) != 3)
        throw Error(ErrorKind::Usage,
                    fmt::format("{}: has shape {}; (3, 3) would be right", what, shapeText(rows)));
    Result m;
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column) m[column][row] = rows.at(row, column);
    return m;
}

glm::dvec3 translationOf(const py::handle& value) {
    floatsOf("t", value);
    const Matrix rows = Matrix::ensure(value);
    if (rows.size() != 3)
        throw Error(ErrorKind::Usage, fmt::format("t: has shape {}; (3,) would be right", shapeText(rows)));
    return {rows.data()[0], rows.data()[1], rows.data()[2]};
}

py::array matrixArray(const glm::dmat3& m) {
    Matrix rows({3, 3});
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column) rows.mutable_at(row, column) = m[column][row];
    return rows;
}

Camera fromOpencv(const py::object& k, const py::object& r, const py::object& t, const py::object& size,
                  double pixelCenter) {
    OpencvCamera opencv;
    opencv.intrinsics = matrixOf<glm::dmat3>("K", k);
    opencv.cameraFromWorld = matrixOf<glm::dmat3>("R", r);
    opencv.translation = translationOf(t);
    opencv.pixelCenter = pixelCenter;
    return cameraFrom(opencv, sizeOf(size));
}

py::tuple toOpencv(const Camera& camera, const py::object& size, double pixelCenter) {
    checkCamera(camera);
    const OpencvCamera opencv = opencvFrom(camera, sizeOf(size), pixelCenter);
    py::array_t<double> t(3);
    for (int i = 0; i < 3; ++i) t.mutable_at(i) = opencv.translation[i];
    return py::make_tuple(matrixArray(opencv.intrinsics), matrixArray(opencv.cameraFromWorld), t);
}

// eye + depth * (x right + y up + forward), for the pixels' centres; of parallel rays eye + x right + y up + depth forward.
py::array positions(const Camera& camera, const py::object& depth) {
    checkCamera(camera);
    const Floats z = floatsOf("depth", depth);
    if (z.ndim() != 2)
        throw Error(ErrorKind::Usage,
                    "depth: has shape " + shapeText(z) + "; (height, width) would be right");
    const py::ssize_t height = z.shape(0), width = z.shape(1);
    const CameraAxes axes = cameraAxes(camera);
    const glm::vec3 forward(axes.forward), right(axes.right), up(axes.up);
    const auto perPixel = static_cast<float>(pixelSize(camera, static_cast<int>(height)));
    py::array_t<float> points({height, width, py::ssize_t(3)});
    float* out = points.mutable_data();
    for (py::ssize_t row = 0; row < height; ++row)
        for (py::ssize_t column = 0; column < width; ++column, out += 3) {
            const float x = (static_cast<float>(column) + 0.5f - 0.5f * static_cast<float>(width)) * perPixel;
            const float y = (0.5f * static_cast<float>(height) - static_cast<float>(row) - 0.5f) * perPixel;
            const float along = z.data()[row * width + column];
            const glm::vec3 aside = (camera.isOrthographic() ? 1.0f : along) * (x * right + y * up);
            const glm::vec3 point = camera.eye + along * forward + aside;
            std::copy(&point.x, &point.x + 3, out);
        }
    return points;
}

template <glm::vec3 Camera::*Field>
void defVector(py::class_<Camera>& type, const char* name, const char* doc) {
    type.def_property(
        name, [](const Camera& camera) { return tupleOf(camera.*Field); },
        [name](Camera& camera, const py::object& value) { camera.*Field = vec3Of(name, value); }, doc);
}

void bindCalls(py::class_<Camera>& type) {
    type.def_static("from_opencv", &fromOpencv, py::arg("K"), py::arg("R"), py::arg("t"), py::arg("size"),
                    py::kw_only(), py::arg("pixel_center") = 0.0,
                    "The camera of OpenCV's matrices: pixel ~ K (R x + t), x right, y down, z forward.\n\n"
                    "K: (3, 3), pixels. R: (3, 3) world to camera. t: (3,), metres. size: (width, height).\n"
                    "pixel_center: coordinates of the first pixel's centre; 0 in OpenCV, 0.5 in COLMAP.\n"
                    "Pixels are square and the principal point is the picture's centre; else Error.")
        .def("to_opencv", &toOpencv, py::arg("size"), py::kw_only(), py::arg("pixel_center") = 0.0,
             "K (3, 3), R (3, 3) and t (3,) as from_opencv takes them.")
        .def("positions", &positions, py::arg("depth"),
             "World points, (height, width, 3) in metres, of a depth picture that this camera saw.")
        .def(
            "copy", [](const Camera& camera) { return camera; }, "A camera of its own, the same.")
        .def("__copy__", [](const Camera& camera) { return camera; })
        .def("__deepcopy__", [](const Camera& camera, const py::dict&) { return camera; })
        .def(py::pickle(
            [](const Camera& c) {
                return py::make_tuple(c.name, tupleOf(c.eye), tupleOf(c.target), tupleOf(c.up), c.fovY,
                                      c.zNear, c.zFar, c.lensDiameter, c.focusDistance, c.orthographicHeight);
            },
            [](const py::tuple& c) {
                return Camera{c[0].cast<std::string>(), vec3Of("eye", c[1]),
                              vec3Of("target", c[2]),   vec3Of("up", c[3]),
                              c[4].cast<float>(),       c[5].cast<float>(),
                              c[6].cast<float>(),       c[7].cast<float>(),
                              c[8].cast<float>(),       c.size() > 9 ? c[9].cast<float>() : 0.0f};
            }))
        .def(
            "__eq__", [](const Camera& a, const Camera& b) { return a == b; }, py::is_operator())
        .def("__repr__",
             [](const Camera& c) {
                 const std::string height =
                     c.isOrthographic() ? fmt::format(", orthographic_height={}", c.orthographicHeight) : "";
                 return fmt::format(
                     "Camera(eye=({}, {}, {}), target=({}, {}, {}), up=({}, {}, {}), vfov={}{})", c.eye.x,
                     c.eye.y, c.eye.z, c.target.x, c.target.y, c.target.z, c.up.x, c.up.y, c.up.z, c.fovY,
                     height);
             })
        .attr("__hash__") = py::none();
}

}  // namespace

void bindCamera(py::module_& module) {
    py::class_<Camera> type(
        module, "Camera",
        "A camera: eye and target in metres, vfov its vertical field of view in radians.\n\nnear and far, in "
        "metres, bound what is seen. orthographic_height, in metres, above 0: rays are parallel.");
    type.def(py::init([](const py::object& eye, const py::object& target, const py::object& up, float vfov,
                         float zNear, float zFar) {
                 Camera camera{
                     "", vec3Of("eye", eye), vec3Of("target", target), vec3Of("up", up), vfov, zNear, zFar};
                 checkCamera(camera);
                 return camera;
             }),
             py::arg("eye"), py::arg("target"), py::arg("up") = py::make_tuple(0, 1, 0),
             py::arg("vfov") = Camera{}.fovY, py::kw_only(), py::arg("near") = Camera{}.zNear,
             py::arg("far") = Camera{}.zFar);
    defVector<&Camera::eye>(type, "eye", "Where it stands: x, y, z in metres.");
    defVector<&Camera::target>(type, "target", "What it looks at: x, y, z in metres.");
    defVector<&Camera::up>(type, "up", "Direction that is up in the picture.");
    type.def_readwrite("vfov", &Camera::fovY, "Vertical field of view, radians.")
        .def_readwrite("near", &Camera::zNear, "Nothing nearer is seen; metres.")
        .def_readwrite("far", &Camera::zFar, "Nothing farther is seen; metres.")
        .def_readwrite("orthographic_height", &Camera::orthographicHeight,
                       "Metres that the picture is high, by parallel rays. 0: perspective.")
        .def_readwrite("lens_diameter", &Camera::lensDiameter,
                       "Metres; what is out of focus is blurred. 0: a pinhole.")
        .def_readwrite("focus_distance", &Camera::focusDistance,
                       "To the plane in focus, metres. 0: through the target.")
        .def_readwrite("name", &Camera::name, "Text.");
    bindCalls(type);
}

}  // namespace conelight::python
