// SPDX-License-Identifier: MIT
// What a guest adds to the lists of settings and modes: rows for a group of its own (Settings::groups), the
// name of its mode. To be called at the start of a program, before other threads use settings.
#pragma once

#include "settings/table.h"

namespace conelight::settings {

// Adds rows, listed in front of the settings whose keys begin with `before` (nothing: at the end). A second
// call with the same prefix does nothing. Throws Error(Usage) for a key that there is already.
void registerTable(const std::string& prefix, Table rows, const std::string& before = {});

// Adds the settings of the group T, keys behind `prefix`: "water." makes "water.depth" of "depth".
template <class T>
void registerSettings(const std::string& prefix, const std::vector<Setting<T>>& rows,
                      const std::string& before = {}) {
    Table table;
    add(table, prefix, placeOf<Settings>([](auto& s) -> auto& { return s.groups.template of<T>(); }), rows);
    registerTable(prefix, std::move(table), before);
}

// Adds a name to the choices of setting `mode`, in front of `before` where that is known, else at the end. A
// second call does nothing.
void registerModeName(Mode mode, Mode before);

// The modes that setting `mode` takes, in the order of its choices.
const std::vector<Mode>& knownModes();

}  // namespace conelight::settings
