// SPDX-License-Identifier: MIT
// The module's parts, each in a file of its own; module.cpp calls them in order.
#pragma once

#include <pybind11/pybind11.h>

namespace conelight::python {

void bindSettings(pybind11::module_& module);
void bindCamera(pybind11::module_& module);
void bindParts(pybind11::module_& module);
void bindScene(pybind11::module_& module);
void bindRenderer(pybind11::module_& module);
void bindTracer(pybind11::module_& module);
void bindBake(pybind11::module_& module);
void bindPath(pybind11::module_& module);
void bindPictures(pybind11::module_& module);

}  // namespace conelight::python
