// SPDX-License-Identifier: MIT
// `conelight compare SCENE... --modes A,B --against MODE`: draws scenes in several modes and settings and
// measures each against one truth.
#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

#include "command.h"
#include "comparison.h"
#include "truth_options.h"
#include "variants.h"

namespace conelight::program {

struct CompareSceneOptions {
    std::vector<std::string> scenes;
    VariantOptions variants;
    std::string against = "reference";
    std::string referenceFile;
    std::string cache;
    std::string components = "full,direct,indirect";
    std::string barsOn;  // empty: barsComponent() chooses
    std::string pixels;
    std::string shaderDirectory;
    int frames = 1;
    int timedFrames = 3;
    bool equalTime = false;
    TracerOptions tracer;
    ViewOptions view;
    ComparisonOptions comparison;  // filled by compare.cpp, which owns the options of both forms

    // Options of this form alone; with two pictures they are wrong usage.
    void addTo(CLI::App& command);
    // Options given that say what is seen, as words of `render`.
    std::vector<std::string> viewWords() const;

  private:
    std::vector<const CLI::Option*> ofView_;
};

void compareScene(const CompareSceneOptions& options);

}  // namespace conelight::program
