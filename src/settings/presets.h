// SPDX-License-Identifier: MIT
// Preset words: `traced.quality=draft` fills in several settings at once. A preset is a function that writes
// settings; which word stands in the settings is found by comparing with what each word writes.
#pragma once

#include <optional>
#include <string>

#include "conelight/settings.h"

namespace conelight::settings {

// Writes the settings of a preset word. False: `key` is no preset. Throws Error(Usage): `word` is none of its
// words.
bool applyPreset(Settings& settings, const std::string& key, const std::string& word);

// The word that makes these settings, "custom" when none does; nothing when `key` is no preset.
std::optional<std::string> presetWord(const Settings& settings, const std::string& key);

}  // namespace conelight::settings
