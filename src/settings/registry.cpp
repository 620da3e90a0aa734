// SPDX-License-Identifier: MIT
// Settings and preset words by key: one list, found through a hash map.
#include <algorithm>
#include <iterator>
#include <limits>
#include <set>
#include <unordered_map>

#include "base/log.h"
#include "settings/presets.h"
#include "settings/registry.h"

namespace conelight {
namespace {

struct Registry {
    std::vector<Mode> modes{Mode::Phong, Mode::Cones, Mode::Hybrid, Mode::Traced};
    std::set<std::string> guests;  // prefixes of the tables that were added
    settings::Table table = settings::coreTable();
    std::vector<SettingInfo> infos;                       // of the table, in its order
    std::unordered_map<std::string, std::size_t> places;  // key -> index in both

    Registry() { list(); }
    void list();
};

// The choices of setting `mode`, then the list that programs see.
void Registry::list() {
    settings::Setting<Settings>& mode = table.front();
    mode.info.choices.clear();
    for (const Mode& one : modes) mode.info.choices.emplace_back(one.name());
    infos.clear();
    places.clear();
    const Settings defaults;
    for (settings::Setting<Settings>& row : table) {
        row.info.defaultValue = textOf(row, defaults);
        places.emplace(row.info.key, infos.size());
        infos.push_back(row.info);
    }
}

Registry& registry() {
    static Registry all;
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

namespace settings {

void registerTable(const std::string& prefix, Table rows, const std::string& before) {
    Registry& all = registry();
    if (all.guests.count(prefix) != 0) return;
    for (const Setting<Settings>& row : rows)
        if (all.places.count(row.info.key) != 0)
            base::fail(ErrorKind::Usage,
                       "setting %s: is there already; another prefix than '%s' would be right",
                       row.info.key.c_str(), prefix.c_str());
    all.guests.insert(prefix);
    const auto place = std::find_if(all.table.begin(), all.table.end(), [&](const Setting<Settings>& row) {
        return !before.empty() && row.info.key.compare(0, before.size(), before) == 0;
    });
    all.table.insert(place, std::make_move_iterator(rows.begin()), std::make_move_iterator(rows.end()));
    all.list();
}

void registerModeName(Mode mode, Mode before) {
    Registry& all = registry();
    if (std::find(all.modes.begin(), all.modes.end(), mode) != all.modes.end()) return;
    all.modes.insert(std::find(all.modes.begin(), all.modes.end(), before), mode);
    all.list();
}

const std::vector<Mode>& knownModes() { return registry().modes; }

}  // namespace settings

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

namespace {

// Cones that are given, one by one.
void checkOwnSet(const ConesSettings& cones) {
    if (cones.diffuseSet != DiffuseSet::Own) return;
    if (cones.ownSet.size() > 64)
        base::fail(ErrorKind::Usage,
                   "setting cones.diffuse_set: own has %zu cones; at most 64 would be right",
                   cones.ownSet.size());
    for (std::size_t i = 0; i < cones.ownSet.size(); ++i) {
        const SetCone& cone = cones.ownSet[i];
        const char* right = nullptr;
        if (!(glm::length(cone.direction) > 1e-6f && glm::length(cone.direction) < 1e6f))
            right = "direction: a length above 0";
        else if (!(cone.direction.z >= 0))
            right = "direction: z of 0 or more, above the surface,";
        else if (!(cone.aperture > 0 && cone.aperture <= 2.4f))
            right = "aperture: above 0 and at most 2.4 rad";
        else if (!(cone.weight > 0 && cone.weight < 1e6f))
            right = "weight: above 0 and below 1e6";
        if (right != nullptr)
            base::fail(ErrorKind::Usage, "setting cones.diffuse_set: own, cone %zu: %s would be right", i + 1,
                       right);
    }
}

}  // namespace

void validateSettings(const Settings& settings) {
    for (const settings::Setting<Settings>& setting : registry().table) check(setting, settings);
    checkOwnSet(settings.cones);
}

}  // namespace conelight
