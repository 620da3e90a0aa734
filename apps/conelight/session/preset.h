// SPDX-License-Identifier: MIT
// Settings under a name, as a file: those that are not as a scene starts, and the mode.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "conelight/settings.h"

namespace conelight::program {

struct Preset {
    std::string mode;                                         // one of the program's; empty: not said
    std::vector<std::pair<std::string, std::string>> values;  // key, value; never the mode

    // Preset words such as traced.quality are read before the settings that they fill in.
    void apply(Settings& settings) const;
};

// What has to be set, in this order, to make `from` into `to`.
std::vector<std::pair<std::string, std::string>> differences(const Settings& from, const Settings& to);

// JSON (docs/reference/settings.md, "Presets"). Reading throws Error(BadInput) "FILE:LINE: what is wrong;
// what would be right"; writing Error(Runtime), and Error(Usage) when there is a file and not `overwrite`.
Preset readPreset(const std::string& file);
void writePreset(const std::string& file, const Preset& preset, bool overwrite);

// The presets in a folder, by name. Throws Error(BadInput) for what is no folder.
std::vector<std::string> presetsIn(const std::string& folder);

}  // namespace conelight::program
