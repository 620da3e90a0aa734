// SPDX-License-Identifier: MIT
// Handles of a scene's parts: attributes read and write the scene; int(handle) is the index.
#include <algorithm>

#include <fmt/core.h>

#include "arrays.h"
#include "bindings.h"
#include "io/scene_info.h"
#include "parts.h"

namespace conelight::python {
namespace {

// `fields` lives as long as the module.
template <class PartOf, class T>
py::class_<PartOf> bindPart(py::module_& module, const char* name, const char* doc,
                            const std::vector<Attribute<T>>& fields) {
    py::class_<PartOf> type(module, name, doc);
    for (const Attribute<T>& field : fields)
        type.def_property(
            field.name, [&field](const PartOf& part) { return field.get(part.get()); },
            [&field](const PartOf& part, const py::object& value) {
                T changed = part.get();
                setAttribute(field, changed, value);
                part.edit() = std::move(changed);
            },
            field.doc);
    const std::string word = name;
    type.def_property_readonly(
            "index", [](const PartOf& part) { return part.index; }, "Its number in the scene.")
        .def("__index__", [](const PartOf& part) { return part.index; })
        .def(
            "__eq__",
            [](const PartOf& a, const PartOf& b) { return a.scene == b.scene && a.index == b.index; },
            py::is_operator())
        .def("__hash__",
             [](const PartOf& part) { return std::hash<const void*>()(part.scene.get()) ^ part.index; })
        .def("__repr__", [word](const PartOf& part) {
            return fmt::format("<conelight.{} {} '{}'>", word, part.index, part.get().name);
        });
    return type;
}

const std::vector<Attribute<Mesh>> kNoFields;

// Rows of a mesh as an array that cannot be written to; None where the mesh has none.
template <auto Member>
py::object rowsOf(const MeshPart& part) {
    const auto& rows = part.get().*Member;
    return rows.empty() ? py::none() : py::object(arrayOf(rows));
}

py::array indicesArray(const MeshPart& part) {
    const std::vector<std::uint32_t>& indices = part.get().indices;
    py::array_t<std::uint32_t> array({static_cast<py::ssize_t>(indices.size() / 3), py::ssize_t(3)});
    std::copy(indices.begin(), indices.end(), array.mutable_data());
    array.attr("setflags")(py::arg("write") = false);
    return array;
}

// New positions, normals and the rest; attributes that are not given are gone.
void replace(const MeshPart& part, const py::object& positions, const py::object& indices,
             const py::kwargs& attributes) {
    part.check();
    Mesh mesh = meshOf(positions, indices, attributes);
    if (mesh.name.empty()) mesh.name = part.get().name;
    part.scene->editGeometry().meshes[part.index] = std::move(mesh);
}

}  // namespace

void bindParts(py::module_& module) {
    bindPart<MeshPart>(module, "Mesh", "Triangles of a scene. Its arrays are copies.", kNoFields)
        .def_property_readonly(
            "name", [](const MeshPart& part) { return part.get().name; }, "Text.")
        .def_property_readonly(
            "positions", [](const MeshPart& part) { return arrayOf(part.get().positions); },
            "(N, 3) float32, metres.")
        .def_property_readonly("indices", &indicesArray, "(M, 3) uint32, counter-clockwise from the front.")
        .def_property_readonly("normals", &rowsOf<&Mesh::normals>, "(N, 3) float32, or None.")
        .def_property_readonly("uvs", &rowsOf<&Mesh::uvs>, "(N, 2) float32, or None.")
        .def_property_readonly("tangents", &rowsOf<&Mesh::tangents>, "(N, 4) float32, or None.")
        .def_property_readonly("colors", &rowsOf<&Mesh::colors>, "(N, 4) float32, linear, or None.")
        .def("replace", &replace, py::arg("positions"), py::arg("indices"),
             "Other triangles in their place: positions (N, 3), indices (M, 3).\n\n"
             "By name: normals, uvs, tangents, colors, name, as Scene.add_mesh takes them; what is not given "
             "is gone.");
    bindPart<MaterialPart>(module, "Material", "A material of a scene: metallic-roughness, as in glTF.",
                           materialAttributes());
    bindPart<InstancePart>(module, "Instance", "One placement of a mesh.", instanceAttributes());
    bindPart<LightPart>(module, "Light", "A light of a scene.", lightAttributes())
        .def_property_readonly(
            "type", [](const LightPart& part) { return io::lightTypeName(part.get().type); },
            "'point', 'spot', 'directional' or 'rect'.");
}

}  // namespace conelight::python
