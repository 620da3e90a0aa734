// SPDX-License-Identifier: MIT
// Which lenses and heights a camera may be given, wherever numbers are typed.
#pragma once

namespace conelight::program {

constexpr float kWidestLens = 100;  // m, of the diameter: a landscape like a model on a table
constexpr float kLeastView = 1e-6f, kTallestView = 1e9f;  // m, of what parallel rays show

}  // namespace conelight::program
