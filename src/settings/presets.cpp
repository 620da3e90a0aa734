// SPDX-License-Identifier: MIT
#include "settings/presets.h"

#include "base/log.h"
#include "conelight/quality.h"

namespace conelight {
namespace {

constexpr const char* kQualityKey = "traced.quality";

SettingInfo qualityPreset() {
    SettingInfo info;
    info.key = kQualityKey;
    info.kind = SettingKind::Choice;
    info.isPreset = true;
    for (const QualityInfo& quality : qualityInfos()) info.choices.push_back(quality.name);
    info.defaultValue = getSetting(Settings{}, kQualityKey);
    info.help = "fills in the other settings of this group (all but bounces and budgeted); set it first";
    return info;
}

}  // namespace

const std::vector<SettingInfo>& presetInfos() {
    static const std::vector<SettingInfo> infos{qualityPreset()};
    return infos;
}

namespace settings {

bool applyPreset(Settings& settings, const std::string& key, const std::string& word) {
    if (key != kQualityKey) return false;
    std::string names;
    for (const QualityInfo& info : qualityInfos()) {
        if (info.name == word) {
            applyQuality(settings.traced, info.quality);
            return true;
        }
        names += (names.empty() ? "" : ",") + info.name;
    }
    base::fail(ErrorKind::Usage, "setting %s: '%s' is not usable; one of %s would be right", key.c_str(),
               word.c_str(), names.c_str());
}

std::optional<std::string> presetWord(const Settings& settings, const std::string& key) {
    if (key != kQualityKey) return std::nullopt;
    const std::optional<Quality> quality = qualityOf(settings.traced);
    for (const QualityInfo& info : qualityInfos())
        if (info.quality == quality) return info.name;
    return "custom";
}

}  // namespace settings
}  // namespace conelight
