// SPDX-License-Identifier: MIT
// `conelight study WHAT`: searches that answer a question of the thesis by measurement.
#pragma once

#include <CLI/CLI.hpp>

namespace conelight::program {

void addStudyCones(CLI::App& study);

}  // namespace conelight::program
