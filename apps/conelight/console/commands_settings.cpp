// SPDX-License-Identifier: MIT
// Commands that read and change the settings of the picture.
#include <fmt/core.h>

#include "conelight/error.h"
#include "console/console.h"

#include <algorithm>

namespace conelight::program {
namespace {

// KEY VALUE, or KEY=VALUE as --set takes it.
void set(const CommandContext& context) {
    std::string key = context.words[0], value;
    const std::size_t equals = key.find('=');
    if (context.count() == 2) {
        value = context.words[1];
    } else if (equals != std::string::npos) {
        value = key.substr(equals + 1);
        key.resize(equals);
    } else {
        throw Error(ErrorKind::Usage,
                    fmt::format("set: {} has no value; set {} VALUE would be right", key, key));
    }
    context.session.setSetting(key, value);
}

std::vector<const SettingInfo*> infosOf(const std::string& command, const std::string& key) {
    std::vector<const SettingInfo*> found;
    if (const SettingInfo* info = findSetting(key)) return {info};
    std::vector<std::string> keys;
    for (const SettingInfo* info : listedSettings()) {
        keys.push_back(info->key);
        if (info->key.compare(0, key.size(), key) == 0) found.push_back(info);
    }
    if (!found.empty()) return found;
    const std::string near = nearest(key, keys);
    throw Error(ErrorKind::Usage,
                fmt::format("{}: there is no setting '{}'{}", command, key,
                            near.empty() ? "; `get` lists all" : "; " + near + " would be right"));
}

void get(const CommandContext& context) {
    const std::vector<const SettingInfo*> infos = infosOf("get", context.count() > 0 ? context.words[0] : "");
    for (const SettingInfo* info : infos)
        context.print(fmt::format(
            "{} = {}{}{}", info->key,
            info->key == "mode" ? context.session.mode() : getSetting(context.session.settings(), info->key),
            info->unit.empty() ? "" : " ", info->unit));
    if (infos.size() == 1)
        context.print(fmt::format("  {}; {}, default {}", infos[0]->help, rangeText(*infos[0]),
                                  infos[0]->defaultValue));
}

void reset(const CommandContext& context) {
    const Settings start = context.session.startingSettings();
    Settings settings = context.session.settings();
    const std::string key = context.count() > 0 ? context.words[0] : "";
    const std::vector<const SettingInfo*> infos = infosOf("reset", key);
    for (const SettingInfo* info : infos) {
        // A preset word only by its own name: its settings are in the list.
        if (info->key != "mode" && (!info->isPreset || infos.size() == 1))
            setSetting(settings, info->key, getSetting(start, info->key));
    }
    context.session.setSettings(settings, "reset " + key);
}

void mode(const CommandContext& context) {
    if (context.count() > 0) return context.session.setMode(context.words[0]);
    context.print("mode: " + context.session.mode());
}

void component(const CommandContext& context) {
    if (context.count() > 0) return context.session.setSetting("component", context.words[0]);
    context.print("component: " + getSetting(context.session.settings(), "component"));
}

void undo(const CommandContext& context) {
    const auto label = context.session.undo();
    if (!label) throw Error(ErrorKind::Usage, "undo: nothing to undo");
    context.print("undone: " + *label);
}

void redo(const CommandContext& context) {
    const auto label = context.session.redo();
    if (!label) throw Error(ErrorKind::Usage, "redo: nothing to redo");
    context.print("redone: " + *label);
}

}  // namespace

CommandGroup settingCommands() {
    const Argument key{"KEY", ArgumentKind::Setting};
    Argument optionalKey = key;
    optionalKey.optional = true;
    return {
        "Settings",
        {
            command("mode", {{"MODE", ArgumentKind::Mode, true}}, "how the picture is made", mode,
                    "Without MODE it is printed."),
            command("component",
                    {{"NAME", ArgumentKind::Choice, true, false, "", 0, 0, settingChoices("component")}},
                    "the part of the picture that is shown", component, "Without NAME it is printed."),
            command("set", {key, {"VALUE", ArgumentKind::SettingValue, true}},
                    "change a setting: KEY VALUE or KEY=VALUE, as --set takes it", set),
            command("get", {optionalKey}, "print a setting, or all that begin with KEY, or all", get),
            command("reset", {optionalKey},
                    "a setting, or all that begin with KEY, or all, as the scene started", reset),
            qualityCommand(),
            presetCommand(),
            command(
                "undo", {}, "take back the last change", undo,
                "Changes of settings, mode, flags, objects, materials, lights, sky, camera path and jumps of "
                "the camera; not flying."),
            command("redo", {}, "bring back what undo took", redo),
        }};
}

}  // namespace conelight::program
