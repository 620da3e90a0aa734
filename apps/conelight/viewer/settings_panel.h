// SPDX-License-Identifier: MIT
// A widget for every setting, made from listedSettings(): slider, box, list; unit, range, default, reset and
// the help text as tool tip. The same texts as `conelight settings` and the documentation.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "conelight/settings.h"

namespace conelight::program {

// Called when the user changed a setting. `done`: the value is final (a drag ended), for undo.
using SettingEdit = std::function<void(const std::string& key, const std::string& value, bool done)>;

class SettingsPanel {
  public:
    // All settings whose key starts with one of `prefixes`, in the order of these, and holds `filter` (empty: all). `revision` grows
    // when `settings` change: their texts are kept until then, for looking them up costs.
    void show(const Settings& settings, std::uint64_t revision, const std::vector<std::string>& prefixes,
              const std::string& filter, const SettingEdit& edit);

  private:
    struct Row {
        const SettingInfo* info = nullptr;
        std::string label, value;
    };
    void gather(const Settings& settings);
    static void showRow(const Row& row, bool inTable, const SettingEdit& edit);
    static void showValue(const Row& row, const SettingEdit& edit);
    static void showNumber(const Row& row, const SettingEdit& edit);

    std::vector<Row> rows_;
    std::vector<std::string> prefixes_;
    std::string filter_;
    std::optional<std::uint64_t> revision_;
};

}  // namespace conelight::program
