// SPDX-License-Identifier: MIT
#include "variants.h"

#include "conelight/error.h"
#include "picture_source.h"

namespace conelight::program {
namespace {

struct Vary {
    std::string key;
    std::vector<std::string> values;
};

Vary parseVary(const std::string& text) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals + 1 == text.size())
        throw Error(ErrorKind::Usage, "--vary: '" + text + "' names no values; KEY=A,B would be right");
    Vary vary{text.substr(0, equals), splitList(text.substr(equals + 1))};
    Settings probe;
    for (const std::string& value : vary.values) setSetting(probe, vary.key, value);
    if (vary.key == "mode" || vary.key == "component")
        throw Error(ErrorKind::Usage,
                    "--vary: " + vary.key + " is not varied here; --modes for modes would be right");
    return vary;
}

bool applies(const std::string& key, const std::string& mode) {
    const std::string stem = key.substr(0, key.find('.'));
    return !isModeName(stem) || stem == mode || (stem == "cones" && mode == "hybrid");
}

}  // namespace

std::string Variant::label() const {
    std::string text = mode;
    for (const auto& [key, value] : values) text += " " + key + "=" + value;
    return text;
}

Settings Variant::settingsFor(const Scene& scene, const ViewOptions& view) const {
    Settings settings = program::settingsFor(scene, isRendererMode(mode) ? mode : "cones", view);
    for (const auto& [key, value] : values) setSetting(settings, key, value);
    return settings;
}

void VariantOptions::addTo(CLI::App& command, const std::string& defaultModes) {
    modes = defaultModes;
    modesOption_ =
        command.add_option("--modes", modes, "what is drawn: " + modeNames() + ", comma-separated")
            ->capture_default_str()
            ->type_name("A,B");
    command.add_option("--vary", varies, "a setting and its values, each with every mode; may be repeated")
        ->type_name("KEY=A,B")
        ->allow_extra_args(false);
}

std::vector<Variant> VariantOptions::variants() const {
    std::vector<Vary> all;
    for (const std::string& text : varies) all.push_back(parseVary(text));
    std::vector<Variant> variants;
    for (const std::string& mode : splitList(modes)) {
        requireModeName(mode);
        std::vector<Variant> ofMode = {{mode, {}}};
        for (const Vary& vary : all) {
            if (!applies(vary.key, mode)) continue;
            std::vector<Variant> next;
            for (const Variant& one : ofMode)
                for (const std::string& value : vary.values) {
                    next.push_back(one);
                    next.back().values.emplace_back(vary.key, value);
                }
            ofMode = std::move(next);
        }
        variants.insert(variants.end(), ofMode.begin(), ofMode.end());
    }
    if (variants.empty())
        throw Error(ErrorKind::Usage, "--modes: there is none; " + modeNames() + " would be right");
    return variants;
}

}  // namespace conelight::program
