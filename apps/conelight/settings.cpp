// SPDX-License-Identifier: MIT
// `conelight settings`: every setting with unit, range and default.
#include <fmt/core.h>

#include "command.h"
#include "conelight/quality.h"
#include "console/statements.h"
#include "session/session.h"

namespace conelight::program {

namespace {

void printQualities(bool markdown) {
    if (!markdown) {
        for (const QualityInfo& info : qualityInfos())
            fmt::print("{:<12} {}\n", info.name, qualityText(info));
        return;
    }
    fmt::print(
        "| quality | rays per pixel | into lobes | rays per voxel face |\n"
        "|---|--:|--:|--:|\n");
    for (const QualityInfo& info : qualityInfos())
        fmt::print("| `{}` | {} | {} | {} |\n", info.name, info.raysPerPixel, info.lobeRays,
                   info.raysPerFace);
}

// Keys and parts of them, of which a filter may be meant.
[[noreturn]] void refuseFilter(const std::string& filter) {
    std::vector<std::string> words;
    for (const SettingInfo* info : listedSettings()) {
        words.push_back(info->key);
        words.push_back(info->key.substr(info->key.rfind('.') + 1));
    }
    const std::string near = nearest(filter, words);
    usage(fmt::format("settings: no key contains '{}'; {} would be right", filter,
                      near.empty() ? "`conelight settings`, which lists all," : near));
}

}  // namespace

void addSettings(CLI::App& app) {
    auto filter = std::make_shared<std::string>();
    auto markdown = std::make_shared<bool>(false);
    CLI::App* command = app.add_subcommand("settings", "every setting of --set with unit, range and default");
    command->add_option("filter", *filter, "show only settings whose key contains this");
    command->add_flag("--markdown", *markdown, "as the table of docs/reference/settings.md");
    auto qualities = std::make_shared<bool>(false);
    command->add_flag("--qualities", *qualities, "instead: what each --quality costs");
    command->callback([filter, markdown, qualities] {
        if (*qualities) return printQualities(*markdown);
        std::vector<const SettingInfo*> listed = listedSettings();
        std::erase_if(listed,
                      [&](const SettingInfo* info) { return info->key.find(*filter) == std::string::npos; });
        if (listed.empty()) refuseFilter(*filter);
        if (*markdown)
            fmt::print("| setting | default | range | unit | what it does |\n|---|---|---|---|---|\n");
        for (const SettingInfo* one : listed) {
            const SettingInfo& info = *one;
            if (*markdown)
                fmt::print("| `{}` | `{}` | {} | {} | {} |\n", info.key, info.defaultValue, rangeText(info),
                           info.unit, info.help);
            else
                fmt::print("{:<36} {:<10} {}{}{}\n{:<36} {}\n", info.key, info.defaultValue, rangeText(info),
                           info.unit.empty() ? "" : " ", info.unit, "", info.help);
        }
    });
}

}  // namespace conelight::program
