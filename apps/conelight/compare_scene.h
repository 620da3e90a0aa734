// SPDX-License-Identifier: MIT
// `conelight compare SCENE --modes A,B --against MODE`: draws a scene in several modes and measures each
// against one of them.
#pragma once

#include <CLI/CLI.hpp>

#include <string>

#include "command.h"
#include "comparison.h"

namespace conelight::program {

struct CompareSceneOptions {
    std::string scene;
    std::string modes = "cones,thesis";
    std::string against = "reference";
    ViewOptions view;
    ComparisonOptions comparison;  // filled by compare.cpp, which owns the options of both forms

    // Options of this form alone; with two pictures they are wrong usage.
    void addTo(CLI::App& command);
};

void compareScene(const CompareSceneOptions& options);

}  // namespace conelight::program
