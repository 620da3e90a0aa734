// SPDX-License-Identifier: MIT
// Which lenses a camera may be given, wherever numbers are typed.
#pragma once

namespace conelight::program {

constexpr float kWidestLens = 100;  // m, of the diameter: a landscape like a model on a table

}  // namespace conelight::program
