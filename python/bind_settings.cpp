// SPDX-License-Identifier: MIT
// Settings: by dotted name, as numbers, bools and words. The names are those of the library's table.
#include <fmt/core.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>

#include "bindings.h"
#include "conelight/error.h"
#include "settings_argument.h"

namespace conelight::python {

namespace py = pybind11;

namespace {

const SettingInfo& infoOf(const std::string& key) {
    const SettingInfo* info = findSetting(key);
    if (info != nullptr) return *info;
    Settings settings;
    setSetting(settings, key, "");  // throws, and names the nearest
    throw Error(ErrorKind::Usage, "there is no setting '" + key + "'");
}

std::string textOf(const SettingInfo& info, const py::handle& value) {
    if (py::isinstance<py::bool_>(value)) {
        const bool on = value.cast<bool>();
        const bool isSwitch = std::find(info.choices.begin(), info.choices.end(), "on") != info.choices.end();
        return isSwitch ? (on ? "on" : "off") : (on ? "true" : "false");
    }
    return py::str(value);
}

py::object valueOf(const SettingInfo& info, const std::string& text) {
    const bool isWord = !info.word.empty() && text == info.word;
    if (info.kind == SettingKind::Bool) return py::bool_(text == "true");
    if (info.kind == SettingKind::Int && !isWord) return py::int_(py::str(text));
    if (info.kind == SettingKind::Float && !isWord) return py::float_(py::str(text));
    return py::str(text);
}

void setValue(Settings& settings, const std::string& key, const py::handle& value) {
    setSetting(settings, key, textOf(infoOf(key), value));
}

py::object getValue(const Settings& settings, const std::string& key) {
    return valueOf(infoOf(key), getSetting(settings, key));
}

void update(Settings& settings, const py::dict& values) {
    Settings changed = settings;
    for (const auto& [key, value] : values) setValue(changed, py::str(key), value);
    settings = changed;
}

std::vector<std::string> keys() {
    std::vector<std::string> all;
    for (const SettingInfo& info : settingInfos()) all.push_back(info.key);
    return all;
}

py::dict describe(const std::string& key) {
    const SettingInfo& info = infoOf(key);
    py::dict text;
    text["key"] = info.key;
    text["default"] = info.isPreset ? py::str(info.defaultValue) : valueOf(info, info.defaultValue);
    text["range"] = rangeText(info);
    text["unit"] = info.unit;
    text["help"] = info.help;
    return text;
}

// What differs from the defaults.
std::string represent(const Settings& settings) {
    const Settings standard;
    std::string text;
    for (const SettingInfo& info : settingInfos()) {
        const std::string value = getSetting(settings, info.key);
        if (value == getSetting(standard, info.key)) continue;
        text += fmt::format("{}'{}': {}", text.empty() ? "" : ", ", info.key,
                            std::string(py::repr(valueOf(info, value))));
    }
    return "Settings({" + text + "})";
}

}  // namespace

Settings settingsOf(const py::object& given) {
    if (py::isinstance<Settings>(given)) return given.cast<Settings>();
    Settings settings;
    if (given.is_none()) return settings;
    if (!py::isinstance<py::dict>(given))
        throw py::type_error("settings: Settings, a dict or None would be right");
    update(settings, given.cast<py::dict>());
    return settings;
}

void bindSettings(py::module_& module) {
    py::class_<Settings>(
        module, "Settings",
        "Settings of the renderer, each by its dotted name: settings['voxels.size'] = 64.\n\n"
        "Values are bool, int, float or str; words such as 'auto' are str. quality fills in those "
        "of\nmode traced ('draft', 'interactive', 'high', 'converged') before values are set.\n"
        "Settings.describe(name) says what a setting does, its range, unit and default.")
        .def(py::init([](const py::dict& values, const py::object& quality) {
                 Settings settings;
                 if (!quality.is_none()) setValue(settings, "traced.quality", quality);
                 update(settings, values);
                 return settings;
             }),
             py::arg("values") = py::dict(), py::kw_only(), py::arg("quality") = py::none())
        .def("get", &getValue, py::arg("key"), "The value of a setting: bool, int, float or str.")
        .def("set", &setValue, py::arg("key"), py::arg("value"),
             "Sets one value; raises Error out of its range.")
        .def("update", &update, py::arg("values"), "Sets all of a dict, in its order, or none of them.")
        .def(
            "copy", [](const Settings& settings) { return settings; }, "Settings of their own, the same.")
        .def(
            "keys", [](const Settings&) { return keys(); }, "Names of all settings.")
        .def_static("describe", &describe, py::arg("key"),
                    "What a setting is: dict of key, default, range, unit, help.")
        .def_property(
            "quality", [](const Settings& settings) { return getSetting(settings, "traced.quality"); },
            [](Settings& settings, const std::string& name) { setSetting(settings, "traced.quality", name); },
            "Quality of mode traced that these settings are; 'custom' when they are none.")
        .def("__copy__", [](const Settings& settings) { return settings; })
        .def("__deepcopy__", [](const Settings& settings, const py::dict&) { return settings; })
        .def(py::pickle(
            [](const Settings& settings) {
                py::dict values;
                for (const std::string& key : keys()) values[key.c_str()] = getSetting(settings, key);
                return values;
            },
            [](const py::dict& values) { return settingsOf(values); }))
        .def("__getitem__", &getValue)
        .def("__setitem__", &setValue)
        .def("__contains__",
             [](const Settings&, const std::string& key) { return findSetting(key) != nullptr; })
        .def("__iter__", [](const Settings&) { return py::iter(py::cast(keys())); })
        .def("__len__", [](const Settings&) { return settingInfos().size(); })
        .def(
            "__eq__", [](const Settings& a, const Settings& b) { return a == b; }, py::is_operator())
        .def("__repr__", &represent)
        .attr("__hash__") = py::none();
}

}  // namespace conelight::python
