// SPDX-License-Identifier: MIT
// What of a scene may be chosen, to be edited, moved, hidden or deleted.
#pragma once

#include <compare>
#include <cstddef>

namespace conelight::program {

enum class SelectionKind { None, Instance, Light, Material };
struct Selection {
    SelectionKind kind = SelectionKind::None;
    std::size_t index = 0;
    auto operator<=>(const Selection&) const = default;
};

}  // namespace conelight::program
