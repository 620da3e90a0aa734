// SPDX-License-Identifier: MIT
#include "components.h"

#include <pybind11/stl.h>

#include "conelight/error.h"

namespace conelight::python {

std::vector<std::string> componentNames(const py::object& given) {
    std::vector<std::string> names;
    try {
        if (py::isinstance<py::str>(given))
            names = {given.cast<std::string>()};
        else
            names = given.cast<std::vector<std::string>>();
    } catch (const py::cast_error&) {
    }
    if (names.empty())
        throw Error(ErrorKind::Usage, "components: " + std::string(py::repr(given)) +
                                          " names none; ['full', 'depth'], for example, would be right");
    return names;
}

Component componentOf(const std::string& name) {
    Settings settings;
    setSetting(settings, "component", name);
    return settings.component;
}

Channels channelsOf(const std::string& name, bool alpha) {
    if (name == "depth" || name == "occlusion") return Channels::Grey;
    return alpha ? Channels::Rgba : Channels::Rgb;
}

}  // namespace conelight::python
