// SPDX-License-Identifier: MIT
// What both forms of `conelight compare` (two pictures; the modes of a scene) share: options, bars that a
// comparison must stay within, and metrics as a table and as JSON.
#pragma once

#include <CLI/CLI.hpp>

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "reference/metrics.h"

namespace conelight::program {

// --max-relrmse 0.05 and the like. A number that is not a number breaks its bar.
struct Bars {
    std::optional<double> bias, mae, rmse, relRmse, blockRelRmse, relMse, psnr, ssim, flip, hdrFlip;
    std::optional<long long> bad;

    void addTo(CLI::App& command);
    bool needFlip() const { return flip || hdrFlip; }
    // One sentence part per bar that is broken: "relRMSE 0.071 is above 0.05 (--max-relrmse)".
    std::vector<std::string> brokenBy(const reference::Metrics& metrics) const;
};

struct ComparisonOptions {
    reference::MetricOptions metrics;
    bool noFlip = false;
    Bars bars;
    std::string jsonFile;  // empty: none; "-": standard output instead of the table
    std::string report;    // folder; empty: none

    void addTo(CLI::App& command);
    // metrics, with noFlip heeded. Throws Error(Usage) when a bar needs what is switched off.
    reference::MetricOptions metricOptions() const;
};

// {"pixels","bad_pixels","mean","reference_mean","bias","mae","mse","rmse","relrmse","block_size","block_relrmse","relmse","psnr_db","ssim",
// "flip","hdr_flip"}; with halves "reference_noise". FLIP only when it was asked for. Infinite: null.
nlohmann::ordered_json metricsJson(const reference::Metrics& metrics, bool withFlip, bool withHalves);

// "4x4": the blocks of blockRelRmse.
std::string blocksText(const reference::Metrics& metrics);

// One row per metric: name, value, unit, meaning.
struct MetricRow {
    std::string name, value, unit, meaning;
};
std::vector<MetricRow> metricRows(const reference::Metrics& metrics, bool withFlip, bool withHalves);

// Columns aligned, two blanks between; the second one to the right.
std::string alignedTable(const std::vector<MetricRow>& rows);

// Throws Error(Runtime) that names `what` and every broken bar; nothing when none is.
void requireBars(const std::string& what, const std::vector<std::string>& broken);

// Writes `json` to the file, or to standard output for "-".
void writeComparisonJson(const std::string& file, const nlohmann::ordered_json& json);

}  // namespace conelight::program
