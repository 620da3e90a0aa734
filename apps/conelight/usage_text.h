// SPDX-License-Identifier: MIT
// What is said of a command line that CLI11 refuses: a mistyped command or option is named, with the one that
// is nearest to it.
#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace conelight::program {

// One line without the program's name. `words`: the command line without the program.
std::string usageText(const CLI::App& app, const CLI::ParseError& error,
                      const std::vector<std::string>& words);

}  // namespace conelight::program
