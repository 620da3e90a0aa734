// SPDX-License-Identifier: MIT
// A widget for every setting, made from settingInfos(): slider, box, list; unit, range, default, reset and
// the help text as tool tip. The same texts as `conelight settings` and the documentation.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "conelight/settings.h"

namespace conelight::program {

// Called when the user changed a setting. `done`: the value is final (a drag ended), for undo.
using SettingEdit = std::function<void(const std::string& key, const std::string& value, bool done)>;

// All settings whose key starts with one of `prefixes` and holds `filter` (empty: all).
void settingsPanel(const Settings& settings, const std::vector<std::string>& prefixes,
                   const std::string& filter, const SettingEdit& edit);
// One setting's row.
void settingRow(const Settings& settings, const SettingInfo& info, const SettingEdit& edit);

// The two numbers of a range like "0.1..2"; false for lists.
bool rangeOf(const SettingInfo& info, double& low, double& high);

}  // namespace conelight::program
