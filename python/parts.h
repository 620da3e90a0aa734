// SPDX-License-Identifier: MIT
// Fields of materials, instances and lights as attributes in Python, by name; what the handles' properties and
// the keyword arguments of Scene.add_... have in common.
#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <vector>

#include "scene_handle.h"

namespace conelight::python {

namespace py = pybind11;

// A name in Python, how it is read and written, and what it is.
template <class T>
struct Attribute {
    const char* name;
    py::object (*get)(const T&);
    void (*set)(T&, const py::handle&);
    const char* doc;
};

const std::vector<Attribute<Material>>& materialAttributes();
const std::vector<Attribute<Instance>>& instanceAttributes();
const std::vector<Attribute<Light>>& lightAttributes();

// Sets one; what is wrong with the value is said with the attribute's name.
template <class T>
void setAttribute(const Attribute<T>& attribute, T& object, const py::handle& value) {
    try {
        attribute.set(object, value);
    } catch (const Error& error) {
        throw Error(error.kind(), std::string(attribute.name) + ": " + error.what());
    }
}

// Sets attributes by name; one that does not exist is a TypeError.
template <class T>
void setAttributes(const char* call, const std::vector<Attribute<T>>& attributes, T& object,
                   const py::kwargs& values) {
    for (const auto& [key, value] : values) {
        const std::string name = py::str(key);
        const Attribute<T>* found = nullptr;
        for (const Attribute<T>& attribute : attributes)
            if (name == attribute.name) found = &attribute;
        if (found == nullptr)
            throw py::type_error(std::string(call) + "() got an unexpected keyword argument '" + name + "'");
        setAttribute(*found, object, value);
    }
}

LightType lightTypeOf(const std::string& name);
Mesh meshOf(const py::object& positions, const py::object& indices, const py::kwargs& attributes);
Texture textureOf(const py::object& pixels, const py::kwargs& options);

}  // namespace conelight::python
