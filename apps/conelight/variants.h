// SPDX-License-Identifier: MIT
// What is compared: modes times settings. "--modes thesis,cones --vary voxels.size=64,128" are four variants.
#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <utility>
#include <vector>

#include "command.h"

namespace conelight::program {

struct Variant {
    std::string mode;
    std::vector<std::pair<std::string, std::string>> values;  // key, value

    std::string label() const;  // "cones voxels.size=64"
    // The settings a scene starts with in this mode, then --set, then the values.
    Settings settingsFor(const Scene& scene, const ViewOptions& view) const;
};

struct VariantOptions {
    std::string modes;
    std::vector<std::string> varies;

    void addTo(CLI::App& command, const std::string& defaultModes);
    bool modesGiven() const { return modesOption_ != nullptr && modesOption_->count() > 0; }
    // Every mode with every combination of the values. Keys that start with the name of a mode belong to
    // that mode alone, those of cones to hybrid, too. Throws Error(Usage).
    std::vector<Variant> variants() const;

  private:
    const CLI::Option* modesOption_ = nullptr;
};

}  // namespace conelight::program
