// SPDX-License-Identifier: MIT
// Settings and preset words by key: one list, found through a hash map.
#include <algorithm>
#include <limits>
#include <unordered_map>

#include "base/log.h"
#include "settings/presets.h"
#include "settings/table.h"

namespace conelight {
namespace {

struct Registry {
    settings::Table table;
    std::vector<SettingInfo> infos;                       // of the table, in its order
    std::unordered_map<std::string, std::size_t> places;  // key -> index in both

    Registry() : table(settings::coreTable()) {
        const Settings defaults;
        for (settings::Setting<Settings>& row : table) {
            row.info.defaultValue = textOf(row, defaults);
            places.emplace(row.info.key, infos.size());
            infos.push_back(row.info);
        }
    }
};

const Registry& registry() {
    static const Registry all;
    return all;
}

// Edit distance, for naming the nearest known key.
std::size_t editDistance(const std::string& a, const std::string& b) {
    std::vector<std::size_t> row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t above = row[j];
            row[j] = std::min({row[j] + 1, row[j - 1] + 1, diagonal + (a[i - 1] != b[j - 1] ? 1u : 0u)});
            diagonal = above;
        }
    }
    return row[b.size()];
}

[[noreturn]] void unknownKey(const std::string& key) {
    const SettingInfo* nearest = nullptr;
    std::size_t best = std::numeric_limits<std::size_t>::max();
    for (const std::vector<SettingInfo>* infos : {&settingInfos(), &presetInfos()}) {
        for (const SettingInfo& info : *infos) {
            const std::size_t distance = editDistance(key, info.key);
            if (distance >= best) continue;
            best = distance;
            nearest = &info;
        }
    }
    base::fail(
        ErrorKind::Usage,
        "setting %s: there is no such setting; %s would be the nearest (`conelight settings` lists all)",
        key.c_str(), nearest->key.c_str());
}

const settings::Setting<Settings>& settingOf(const std::string& key) {
    const Registry& all = registry();
    const auto found = all.places.find(key);
    if (found == all.places.end()) unknownKey(key);
    return all.table[found->second];
}

}  // namespace

const std::vector<SettingInfo>& settingInfos() { return registry().infos; }

const SettingInfo* findSetting(const std::string& key) {
    const Registry& all = registry();
    const auto found = all.places.find(key);
    if (found != all.places.end()) return &all.infos[found->second];
    for (const SettingInfo& preset : presetInfos())
        if (preset.key == key) return &preset;
    return nullptr;
}

void setSetting(Settings& settings, const std::string& key, const std::string& value) {
    if (settings::applyPreset(settings, key, value)) return;
    setFromText(settingOf(key), settings, value);
}

std::string getSetting(const Settings& settings, const std::string& key) {
    if (const std::optional<std::string> word = settings::presetWord(settings, key)) return *word;
    return textOf(settingOf(key), settings);
}

void validateSettings(const Settings& settings) {
    for (const settings::Setting<Settings>& setting : registry().table) check(setting, settings);
}

}  // namespace conelight
