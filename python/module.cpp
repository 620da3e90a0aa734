// SPDX-License-Identifier: MIT
// The extension conelight._conelight; what users import is conelight/__init__.py.
#include "bindings.h"
#include "calls.h"
#include "conelight/version.h"
#include "guests.h"
#include "platform/headless_context.h"

namespace conelight::python {
namespace {

const char* nameOf(ErrorKind kind) {
    switch (kind) {
        case ErrorKind::Runtime:
            return "runtime";
        case ErrorKind::Usage:
            return "usage";
        case ErrorKind::BadInput:
            return "bad_input";
        case ErrorKind::NoGl:
            return "no_gl";
    }
    return "runtime";
}

// conelight::Error becomes conelight.Error, its kind an attribute. The type outlives the module.
PyObject* errorType = nullptr;

void bindError(py::module_& module) {
    errorType = PyErr_NewExceptionWithDoc(
        "conelight.Error",
        "What Conelight refuses or fails at: one line that says where, what is wrong and what would be "
        "right.\n\n"
        "kind: 'usage' (arguments, settings), 'bad_input' (a file or scene that cannot be used),\n"
        "'no_gl' (no usable OpenGL 4.5) or 'runtime'.",
        PyExc_RuntimeError, nullptr);
    if (errorType == nullptr) throw py::error_already_set();
    module.add_object("Error", py::reinterpret_borrow<py::object>(errorType));
    py::register_exception_translator([](std::exception_ptr caught) {
        try {
            if (caught) std::rethrow_exception(caught);
        } catch (const Error& error) {
            const py::object value = py::reinterpret_borrow<py::object>(errorType)(error.what());
            value.attr("kind") = nameOf(error.kind());
            PyErr_SetObject(errorType, value.ptr());
        }
    });
}

}  // namespace
}  // namespace conelight::python

PYBIND11_MODULE(_conelight, module) {
    using namespace conelight::python;
    conelight::program::registerGuests();
    module.attr("__name__") = "conelight";  // where users find the types
    keepMessages();
    module.attr("__version__") = CONELIGHT_VERSION_STRING;
    bindError(module);
    bindSettings(module);
    bindCamera(module);
    bindParts(module);
    bindScene(module);
    bindRenderer(module);
    bindTracer(module);
    bindBake(module);
    bindPath(module);
    bindPictures(module);
    module.attr("__name__") = "conelight._conelight";
}
