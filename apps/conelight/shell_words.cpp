// SPDX-License-Identifier: MIT
#include "shell_words.h"

#include <algorithm>
#include <filesystem>

#include "conelight/quality.h"
#include "session/session.h"

namespace conelight::program {
namespace {

void addWords(const CLI::App& app, const std::string& path, std::vector<CommandWords>& all) {
    CommandWords words{path, &app, {}, {}};
    words.commands = app.get_subcommands([](const CLI::App* one) { return !one->get_name().empty(); });
    for (const CLI::Option* option : app.get_options())
        if (!namesOf(*option).empty()) words.options.push_back(option);
    all.push_back(words);
    for (const CLI::App* one : words.commands)
        addWords(*one, path.empty() ? one->get_name() : path + " " + one->get_name(), all);
}

}  // namespace

std::vector<CommandWords> commandWords(const CLI::App& app) {
    std::vector<CommandWords> all;
    addWords(app, "", all);
    return all;
}

std::vector<std::string> namesOf(const CLI::Option& option) {
    std::vector<std::string> names;
    for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
    for (const std::string& name : option.get_snames()) names.push_back("-" + name);
    return names;
}

std::vector<std::string> valuesOf(const CLI::Option& option) {
    const std::vector<std::string> names = namesOf(option);
    const auto is = [&](const char* name) {
        return std::find(names.begin(), names.end(), name) != names.end();
    };
    std::vector<std::string> words;
    if (is("--mode") || is("--modes") || is("--against")) return sessionModes();
    if (is("--component")) return settingChoices("component");
    if (is("--quality"))
        for (const QualityInfo& info : qualityInfos()) words.push_back(info.name);
    if (is("--set"))
        for (const SettingInfo* info : listedSettings()) words.push_back(info->key + "=");
    return words;
}

std::string shortHelp(const std::string& help) {
    const std::size_t end = std::min(help.find('\n'), help.find("; "));
    return help.substr(0, end);
}

std::vector<std::string> withCommand(const CLI::App& app, std::vector<std::string> words) {
    if (words.empty() || words.front().empty() || words.front().front() == '-') return words;
    const std::string& first = words.front();
    const auto isIt = [&](const CLI::App* one) { return one->get_name() == first; };
    if (!app.get_subcommands(isIt).empty()) return words;
    std::error_code ignored;
    // What does not exist but has a folder or an extension was meant as a file: `view` says what is wrong.
    const bool scene = first.rfind("builtin:", 0) == 0 || std::filesystem::exists(first, ignored) ||
                       first.find_first_of("/.") != std::string::npos;
    if (scene) words.insert(words.begin(), "view");
    return words;
}

}  // namespace conelight::program
