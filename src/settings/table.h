// SPDX-License-Identifier: MIT
// The tables of the library's own settings. A group is joined to the whole by its prefix and its place.
#pragma once

#include "settings/setting.h"

namespace conelight::settings {

using Table = std::vector<Setting<Settings>>;

// Appends a group's rows, their keys behind `prefix`.
template <class Group>
void add(Table& table, const std::string& prefix, const Place<Settings, Group>& place,
         const std::vector<Setting<Group>>& rows) {
    for (const Setting<Group>& row : rows) table.push_back(within(prefix, place, row));
}

// The choices of setting `mode`, its first row, are the registry's.
Table coreTable();

}  // namespace conelight::settings
