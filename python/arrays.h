// SPDX-License-Identifier: MIT
// Between NumPy and the library's types: arrays in with checked shapes, vectors and matrices both ways, pictures
// out without a copy. What does not fit throws Error(Usage) that starts with `what`, the
// argument's name; where the caller knows it, `what` is empty.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "conelight/renderer.h"

namespace conelight::python {

namespace py = pybind11;

using Floats = py::array_t<float, py::array::c_style | py::array::forcecast>;

// "(4, 3)"
std::string shapeText(const py::array& array);
// Numbers as an array of float32; throws for what NumPy cannot read as numbers.
Floats floatsOf(const std::string& what, const py::handle& value);
// With `columns` columns; any number of rows.
Floats tableOf(const std::string& what, const py::handle& value, py::ssize_t columns);
// Integers >= 0 of shape (M, 3) or (3 M,), flat.
std::vector<std::uint32_t> indicesOf(const std::string& what, const py::handle& value);

glm::vec3 vec3Of(const std::string& what, const py::handle& value);
glm::vec4 vec4Of(const std::string& what, const py::handle& value);
glm::mat3 mat3Of(const std::string& what, const py::handle& value);  // from (3, 3), rows first
// From (4, 4) or (3, 4), whose last row is 0 0 0 1. Column vectors: world = matrix @ object.
glm::mat4 mat4Of(const std::string& what, const py::handle& value);
// Width and height of pictures, each 1 to 16384.
glm::ivec2 sizeOf(const py::handle& value);

py::tuple tupleOf(const glm::vec3& v);
py::tuple tupleOf(const glm::vec4& v);
// Arrays that cannot be written to: a change of them would change nothing.
py::array arrayOf(const glm::mat3& m);
py::array arrayOf(const glm::mat4& m);

template <class Vector>
std::vector<Vector> vectorsOf(const std::string& what, const py::handle& value) {
    const Floats table = tableOf(what, value, Vector::length());
    const auto* first = reinterpret_cast<const Vector*>(table.data());
    return std::vector<Vector>(first, first + table.shape(0));
}

template <class Vector>
py::array arrayOf(const std::vector<Vector>& rows) {
    py::array_t<float> array({static_cast<py::ssize_t>(rows.size()), py::ssize_t(Vector::length())});
    if (!rows.empty()) std::memcpy(array.mutable_data(), rows.data(), rows.size() * sizeof(Vector));
    array.attr("setflags")(py::arg("write") = false);
    return array;
}

// What of a pixel's four numbers an array shows.
enum class Channels { Grey, Rgb, Rgba };
// (height, width), (height, width, 3) or (height, width, 4) over the image's own pixels, which it keeps alive.
py::array pictureArray(Image image, Channels channels);
// (height, width) or (height, width, components) over `rows`, one per pixel, which it keeps.
template <class Number, class Row>
py::array ownedArray(const glm::ivec2& size, std::vector<Row> rows) {
    auto* kept = new std::vector<Row>(std::move(rows));
    const py::capsule owner(kept, [](void* held) { delete static_cast<std::vector<Row>*>(held); });
    std::vector<py::ssize_t> shape = {size.y, size.x};
    constexpr py::ssize_t kComponents = sizeof(Row) / sizeof(Number);
    if (kComponents > 1) shape.push_back(kComponents);
    return py::array(py::dtype::of<Number>(), shape, kept->data(), owner);
}
// From any of these shapes; alpha is 1 where there is none.
Image imageOf(const std::string& what, const py::handle& value);

}  // namespace conelight::python
