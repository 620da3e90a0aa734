// SPDX-License-Identifier: MIT
#include "arrays.h"

#include <fmt/core.h>

#include <limits>

#include "conelight/error.h"

namespace conelight::python {
namespace {

[[noreturn]] void fail(const std::string& what, const std::string& why) {
    throw Error(ErrorKind::Usage, what.empty() ? why : what + ": " + why);
}

// `count` numbers in a row.
Floats rowOf(const std::string& what, const py::handle& value, py::ssize_t count) {
    Floats row = floatsOf(what, value);
    if (row.ndim() != 1 || row.shape(0) != count)
        fail(what, fmt::format("has shape {}; {} numbers, shape ({},), would be right", shapeText(row), count,
                               count));
    return row;
}

void isReadOnly(const py::array& array) { array.attr("setflags")(py::arg("write") = false); }

template <class Matrix>
py::array rowsOf(const Matrix& m) {
    constexpr py::ssize_t n = Matrix::length();
    py::array_t<float> array({n, n});
    for (py::ssize_t row = 0; row < n; ++row)
        for (py::ssize_t column = 0; column < n; ++column)
            array.mutable_at(row, column) = m[int(column)][int(row)];
    isReadOnly(array);
    return array;
}

}  // namespace

std::string shapeText(const py::array& array) {
    std::string text;
    for (py::ssize_t i = 0; i < array.ndim(); ++i)
        text += (i > 0 ? ", " : "") + std::to_string(array.shape(i));
    return "(" + text + (array.ndim() == 1 ? ",)" : ")");
}

Floats floatsOf(const std::string& what, const py::handle& value) {
    if (!value.is_none()) {
        Floats array = Floats::ensure(value);
        if (array) return array;
        PyErr_Clear();
    }
    fail(what, fmt::format("is no array of numbers, but {}",
                           std::string(py::str(value.get_type().attr("__name__")))));
}

Floats tableOf(const std::string& what, const py::handle& value, py::ssize_t columns) {
    Floats table = floatsOf(what, value);
    if (table.size() == 0) return Floats(std::vector<py::ssize_t>{0, columns});
    if (table.ndim() != 2 || table.shape(1) != columns)
        fail(what, fmt::format("has shape {}; (N, {}) would be right", shapeText(table), columns));
    return table;
}

std::vector<std::uint32_t> indicesOf(const std::string& what, const py::handle& value) {
    const py::array any = py::array::ensure(value);
    if (!any) PyErr_Clear();
    const bool integers = any && (any.dtype().kind() == 'i' || any.dtype().kind() == 'u');
    if (any && any.size() == 0) return {};
    if (!integers) fail(what, "are no integers; an array of uint32, shape (M, 3), would be right");
    const bool flat = any.ndim() == 1 && any.shape(0) % 3 == 0;
    if (!flat && (any.ndim() != 2 || any.shape(1) != 3))
        fail(what, fmt::format("have shape {}; (M, 3) would be right", shapeText(any)));
    using Wide = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>;
    const Wide wide = Wide::ensure(any);
    std::vector<std::uint32_t> indices(static_cast<std::size_t>(wide.size()));
    for (std::size_t i = 0; i < indices.size(); ++i) {
        const std::int64_t index = wide.data()[i];
        if (index < 0 || index > std::numeric_limits<std::uint32_t>::max())
            fail(what, fmt::format("hold {}; numbers of rows of positions, from 0, would be right", index));
        indices[i] = static_cast<std::uint32_t>(index);
    }
    return indices;
}

glm::vec3 vec3Of(const std::string& what, const py::handle& value) {
    const Floats v = rowOf(what, value, 3);
    return {v.at(0), v.at(1), v.at(2)};
}

glm::vec4 vec4Of(const std::string& what, const py::handle& value) {
    const Floats v = rowOf(what, value, 4);
    return {v.at(0), v.at(1), v.at(2), v.at(3)};
}

glm::mat3 mat3Of(const std::string& what, const py::handle& value) {
    const Floats rows = floatsOf(what, value);
    if (rows.ndim() != 2 || rows.shape(0) != 3 || rows.shape(1) != 3)
        fail(what, fmt::format("has shape {}; (3, 3) would be right", shapeText(rows)));
    glm::mat3 m;
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column) m[column][row] = rows.at(row, column);
    return m;
}

glm::mat4 mat4Of(const std::string& what, const py::handle& value) {
    const Floats rows = floatsOf(what, value);
    if (rows.ndim() != 2 || (rows.shape(0) != 3 && rows.shape(0) != 4) || rows.shape(1) != 4)
        fail(what, fmt::format("has shape {}; (4, 4) would be right", shapeText(rows)));
    glm::mat4 m{1.0f};
    for (int row = 0; row < rows.shape(0); ++row)
        for (int column = 0; column < 4; ++column) m[column][row] = rows.at(row, column);
    return m;
}

glm::ivec2 sizeOf(const py::handle& value) {
    constexpr int kMost = 16384;
    try {
        const auto [width, height] = value.cast<std::pair<int, int>>();
        if (width >= 1 && height >= 1 && width <= kMost && height <= kMost) return {width, height};
    } catch (const py::cast_error&) {
    }
    fail("size", fmt::format("{} is no picture size; (width, height) with 1 to {} each would be right",
                             std::string(py::repr(value)), kMost));
}

py::tuple tupleOf(const glm::vec3& v) { return py::make_tuple(v.x, v.y, v.z); }
py::tuple tupleOf(const glm::vec4& v) { return py::make_tuple(v.x, v.y, v.z, v.w); }
py::array arrayOf(const glm::mat3& m) { return rowsOf(m); }
py::array arrayOf(const glm::mat4& m) { return rowsOf(m); }

py::array pictureArray(Image image, Channels channels) {
    const py::ssize_t height = image.height, width = image.width;
    constexpr py::ssize_t kNumber = sizeof(float), kPixel = sizeof(glm::vec4);
    auto* kept = new Image(std::move(image));
    const py::capsule owner(kept, [](void* held) { delete static_cast<Image*>(held); });
    std::vector<py::ssize_t> shape = {height, width}, strides = {width * kPixel, kPixel};
    if (channels != Channels::Grey) {
        shape.push_back(channels == Channels::Rgb ? 3 : 4);
        strides.push_back(kNumber);
    }
    return py::array(py::dtype::of<float>(), shape, strides, kept->pixels.data(), owner);
}

Image imageOf(const std::string& what, const py::handle& value) {
    const Floats array = floatsOf(what, value);
    const py::ssize_t channels = array.ndim() == 3 ? array.shape(2) : 1;
    const bool fits =
        array.ndim() == 2 || (array.ndim() == 3 && (channels == 1 || channels == 3 || channels == 4));
    constexpr py::ssize_t kMost = 65536;
    if (!fits || array.size() == 0 || array.shape(0) > kMost || array.shape(1) > kMost)
        fail(what,
             fmt::format("has shape {}; (height, width), (height, width, 3) or (height, width, 4) would "
                         "be right",
                         shapeText(array)));
    Image image{static_cast<int>(array.shape(1)), static_cast<int>(array.shape(0)), {}};
    image.pixels.resize(static_cast<std::size_t>(array.shape(0) * array.shape(1)));
    const float* v = array.data();
    for (glm::vec4& pixel : image.pixels) {
        pixel = {v[0], v[channels > 1 ? 1 : 0], v[channels > 1 ? 2 : 0], channels == 4 ? v[3] : 1.0f};
        v += channels;
    }
    return image;
}

}  // namespace conelight::python
