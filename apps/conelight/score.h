// SPDX-License-Identifier: MIT
// What the scores share: options, one value per variant, its table, JSON and threshold. What each score
// means: docs/guide/scores.md.
#pragma once

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <string>
#include <vector>

#include "command.h"
#include "picture_source.h"
#include "table.h"
#include "truth_options.h"
#include "variants.h"

namespace conelight::program {

void addScoreLeak(CLI::App& score);
void addScoreShift(CLI::App& score);
void addScoreFlicker(CLI::App& score);
void addScoreConvergence(CLI::App& score);
void addScoreEdges(CLI::App& score);

struct ScoreOptions {
    std::vector<std::string> scenes;
    VariantOptions variants;
    ViewOptions view;
    std::string jsonFile;
    double most = -1;  // threshold; < 0: none

    void addTo(CLI::App& command, const std::string& defaultModes, const std::string& defaultSize);
    // Throws Error(Usage) for modes that the score cannot judge, when `rendererModesOnly`.
    std::vector<Variant> checked(const char* score, bool rendererModesOnly) const;
};

// What a variant draws of a scene's view; components are left to the score.
PictureRequest requestOf(const Variant& variant, const Scene& scene, const ViewOptions& view);

// Collects the values of one score; prints, writes and judges them.
class ScoreReport {
  public:
    ScoreReport(std::string score, std::string unit, const ScoreOptions& options);
    // `value` is what the threshold is held against; `what` says where it was found.
    void add(const std::string& what, double value, nlohmann::ordered_json json);
    // Writes the JSON, then throws Error(Runtime) when a value is above the threshold or not a number.
    void finish(const std::string& device);

  private:
    std::string score_;
    const ScoreOptions& options_;
    nlohmann::ordered_json json_;
    std::string worst_;
    double worstValue_ = -1;
    int tooHigh_ = 0, count_ = 0;
};

}  // namespace conelight::program
