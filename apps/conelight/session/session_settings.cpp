// SPDX-License-Identifier: MIT
// Settings that scenes start with, words that settings take, and the program's modes: declared in session.h.
#include <utility>

#include "session/session.h"

namespace conelight::program {

Settings startSettings(const Scene& scene, const std::string& mode) {
    Settings settings;
    if (!mode.empty()) setSetting(settings, "mode", mode);
    // Scenes with a format of their own were made for linear values on the screen: modes of that look keep it
    // unless asked otherwise. Their rooms (closed, albedo 0.85) gather several times their direct light,
    // for which others find an exposure.
    const bool keepsLook = settings.mode == Mode::Phong || getSetting(settings, "mode") == scene.format;
    if (!scene.format.empty() && keepsLook) {
        settings.image.toneMap = ToneMap::None;
        settings.image.srgb = false;
    } else if (!scene.format.empty()) {
        settings.image.exposure = AutoFloat{};
    }
    for (const auto& [key, value] : scene.settings) {
        if (key == "mode" && !mode.empty()) continue;  // the caller wins
        setSetting(settings, key, value);
    }
    return settings;
}

std::optional<io::UpAxis> upAxisOf(const std::string& word) {
    for (const io::UpAxis up : {io::UpAxis::Auto, io::UpAxis::X, io::UpAxis::Y, io::UpAxis::Z})
        if (word == wordOf(up)) return up;
    return std::nullopt;
}

std::string wordOf(io::UpAxis up) {
    switch (up) {
        case io::UpAxis::X:
            return "x";
        case io::UpAxis::Y:
            return "y";
        case io::UpAxis::Z:
            return "z";
        case io::UpAxis::Auto:
            break;
    }
    return "auto";
}

std::vector<std::string> settingChoices(const std::string& key) {
    const SettingInfo* info = findSetting(key);
    return info == nullptr ? std::vector<std::string>{} : info->choices;
}

std::vector<const SettingInfo*> listedSettings() {
    const auto groupOf = [](const std::string& key) { return key.substr(0, key.find('.')); };
    std::vector<const SettingInfo*> listed;
    std::string group;
    for (const SettingInfo& info : settingInfos()) {
        if (groupOf(info.key) != group) {
            group = groupOf(info.key);
            for (const SettingInfo& preset : presetInfos())
                if (groupOf(preset.key) == group) listed.push_back(&preset);
        }
        listed.push_back(&info);
    }
    return listed;
}

bool isSettingsMode(const std::string& mode) {
    return mode != "reference" && mode != "radiosity" && mode != "beams";
}

std::vector<std::string> sessionModes() {
    std::vector<std::string> modes = settingChoices("mode");
    modes.insert(modes.end(), {"reference", "radiosity", "beams"});
    return modes;
}

const char* aboutMode(const std::string& mode) {
    static constexpr std::pair<const char*, const char*> kModes[] = {
        {"traced",
         "rays through surface voxels, irradiance cached per voxel face, unlimited bounces; the default"},
        {"cones", "cone tracing through prefiltered radiance"},
        {"hybrid", "light baked on what does not move, cones for what does and what it changes"},
        {"thesis",
         "the renderer of the bachelor's thesis that Conelight grew from, its defects mended or shown"},
        {"phong", "direct light alone, by the Phong model"},
        {"reference", "path tracer on the CPU, all bounces: the truth the others are measured against"},
        {"radiosity", "light between diffuse surfaces solved once on the CPU and kept at vertices"},
        {"beams", "beam tracing on the CPU: direct light and mirrors of polygons, exact at every edge"}};
    for (const auto& [name, about] : kModes)
        if (mode == name) return about;
    return "";
}

}  // namespace conelight::program
