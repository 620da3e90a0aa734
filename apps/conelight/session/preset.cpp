// SPDX-License-Identifier: MIT
#include "session/preset.h"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>

#include "conelight/error.h"
#include "io/files.h"
#include "io/json_file.h"
#include "session/session.h"

namespace conelight::program {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kPresetKind = "preset";

std::string alternatives(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words)
        text += (text.empty() ? "" : word == words.back() ? " or " : ", ") + word;
    return text;
}

// A value as `set` takes it.
std::string textOf(const io::JsonFile& file, const std::string& pointer, const std::string& key,
                   const Json& value) {
    if (value.is_string()) return value.get<std::string>();
    if (value.is_number() || value.is_boolean()) return value.dump();
    file.fail(pointer, fmt::format("{}: {} is no value; a number, a word, true or false would be right", key,
                                   io::oneLine(value.dump(), 40)));
}

}  // namespace

void Preset::apply(Settings& settings) const {
    for (const SettingInfo* info : listedSettings())
        for (const auto& [key, value] : values)
            if (key == info->key) setSetting(settings, key, value);
}

std::vector<std::pair<std::string, std::string>> differences(const Settings& from, const Settings& to) {
    std::vector<std::pair<std::string, std::string>> found;
    Settings now = from;
    for (const SettingInfo& info : settingInfos()) {
        const std::string value = getSetting(to, info.key);
        if (getSetting(now, info.key) == value) continue;
        setSetting(now, info.key, value);
        found.emplace_back(info.key, value);
    }
    return found;
}

Preset readPreset(const std::string& name) {
    const io::JsonFile file(name);
    const Json& root = file.root();
    if (!root.is_object() || root.value("conelight", Json()) != kPresetKind)
        file.fail("/conelight", "is no preset, which says \"conelight\": \"preset\"");
    for (const auto& [field, value] : root.items())
        if (field != "conelight" && field != "settings")
            file.fail("/" + field,
                      fmt::format("there is no field '{}'; settings would be right", io::oneLine(field, 40)));
    const Json settings = root.value("settings", Json());
    if (!settings.is_object()) file.fail("/settings", "settings: {\"KEY\": VALUE, ...} would be right");
    Preset preset;
    Settings probe;
    for (const auto& [key, json] : settings.items()) {
        const std::string pointer = "/settings/" + key;
        const std::string value = textOf(file, pointer, io::oneLine(key, 60), json);
        try {
            if (key != "mode") {
                setSetting(probe, key, value);
                preset.values.emplace_back(key, value);
                continue;
            }
            const std::vector<std::string> modes = sessionModes();
            if (std::find(modes.begin(), modes.end(), value) == modes.end())
                file.fail(pointer, fmt::format("there is no mode '{}'; {} would be right",
                                               io::oneLine(value, 40), alternatives(modes)));
            preset.mode = value;
        } catch (const Error& error) {
            if (error.kind() == ErrorKind::BadInput) throw;
            file.fail(pointer, error.what());
        }
    }
    return preset;
}

void writePreset(const std::string& name, const Preset& preset, bool overwrite) {
    io::refuseOverwriting(name, overwrite);
    Json settings = Json::object();
    if (!preset.mode.empty()) settings["mode"] = preset.mode;
    for (const auto& [key, value] : preset.values) {
        const Json read = Json::parse(value, nullptr, false);
        // Only what is read back as the same text is written as a number.
        settings[key] = (read.is_number() || read.is_boolean()) && read.dump() == value ? read : Json(value);
    }
    const std::string text = Json({{"conelight", kPresetKind}, {"settings", settings}}).dump(2) + "\n";
    io::writeFile(name, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

std::vector<std::string> presetsIn(const std::string& folder) {
    std::error_code code;
    const std::filesystem::directory_iterator all(folder, code);
    if (code)
        throw Error(ErrorKind::BadInput,
                    fmt::format("{}: {}; a folder would be right", io::oneLine(folder), code.message()));
    std::vector<std::string> names;
    for (const auto& entry : all) {
        if (!entry.is_regular_file(code) || io::lowerExtension(entry.path()) != ".json") continue;
        try {
            const io::JsonFile file(entry.path().string());
            if (file.root().is_object() && file.root().value("conelight", Json()) == kPresetKind)
                names.push_back((std::filesystem::path(folder) / entry.path().filename()).lexically_normal());
        } catch (const Error&) {
            // Some other file of that name.
        }
    }
    std::sort(names.begin(), names.end());
    return names;
}

}  // namespace conelight::program
