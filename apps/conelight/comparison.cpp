// SPDX-License-Identifier: MIT
#include "comparison.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "conelight/error.h"
#include "stats_json.h"

namespace conelight::program {

using nlohmann::ordered_json;
using reference::Metrics;

namespace {

ordered_json numberOrNull(double value) {
    return std::isfinite(value) ? ordered_json(value) : ordered_json();
}

std::string shown(double value, const char* format = "{:.4g}") {
    if (std::isnan(value)) return "none";
    if (std::isinf(value)) return value > 0 ? "infinite" : "-infinite";
    return fmt::format(fmt::runtime(format), value);
}

}  // namespace

void Bars::addTo(CLI::App& command) {
    const auto add = [&](const char* flag, auto& value, const char* text) {
        command.add_option(flag, value, text)->group("Bars (exit status 1 when broken)")->type_name("X");
    };
    add("--max-bias", bias, "largest |bias|, 0.01 = 1 %");
    add("--max-mae", mae, "largest mean absolute error");
    add("--max-rmse", rmse, "largest RMSE");
    add("--max-relrmse", relRmse, "largest RMSE / mean of the reference");
    add("--max-block-relrmse", blockRelRmse, "largest relRMSE of means of blocks (--blocks)");
    add("--max-relmse", relMse, "largest relative MSE");
    add("--min-psnr", psnr, "smallest PSNR, dB");
    add("--min-ssim", ssim, "smallest SSIM");
    add("--max-flip", flip, "largest mean LDR-FLIP");
    add("--max-hdr-flip", hdrFlip, "largest mean HDR-FLIP");
    add("--max-bad", bad, "most pixels that are not finite");
}

std::vector<std::string> Bars::brokenBy(const Metrics& m) const {
    std::vector<std::string> broken;
    const auto atMost = [&](const char* name, double value, const auto& bar, const char* flag) {
        if (bar && !(value <= static_cast<double>(*bar)))
            broken.push_back(fmt::format("{} {} is above {} ({})", name, shown(value), *bar, flag));
    };
    const auto atLeast = [&](const char* name, double value, const auto& bar, const char* flag) {
        if (bar && !(value >= *bar))
            broken.push_back(fmt::format("{} {} is below {} ({})", name, shown(value), *bar, flag));
    };
    atMost("|bias|", std::abs(m.bias), bias, "--max-bias");
    atMost("MAE", m.mae, mae, "--max-mae");
    atMost("RMSE", m.rmse, rmse, "--max-rmse");
    atMost("relRMSE", m.relRmse, relRmse, "--max-relrmse");
    atMost("relRMSE of blocks", m.blockRelRmse, blockRelRmse, "--max-block-relrmse");
    atMost("relMSE", m.relMse, relMse, "--max-relmse");
    atLeast("PSNR", m.psnr, psnr, "--min-psnr");
    atLeast("SSIM", m.ssim, ssim, "--min-ssim");
    atMost("FLIP", m.flip, flip, "--max-flip");
    atMost("HDR-FLIP", m.hdrFlip, hdrFlip, "--max-hdr-flip");
    atMost("number of pixels that are not finite", static_cast<double>(m.badPixels), bad, "--max-bad");
    return broken;
}

void ComparisonOptions::addTo(CLI::App& command) {
    command
        .add_option("--json", jsonFile,
                    "write the numbers as JSON; - writes them to standard output instead of the table")
        ->type_name("FILE");
    command
        .add_option("--report", report,
                    "write an HTML page with pictures, error maps and tables: DIR/index.html")
        ->type_name("DIR");
    command
        .add_option("--exposure", metrics.exposure,
                    "stops, for PSNR, SSIM and FLIP, which compare what a display shows")
        ->capture_default_str()
        ->check(CLI::Range(-32.0, 32.0))
        ->type_name("STOPS");
    command.add_option("--ppd", metrics.pixelsPerDegree, "FLIP: pixels per degree of the viewer's sight")
        ->capture_default_str()
        ->check(CLI::Range(1.0, 500.0))
        ->type_name("N");
    command
        .add_option("--blocks", metrics.blockSize,
                    "measure relRMSE of means of N x N pixels beside that of pixels; 1: the same as that")
        ->capture_default_str()
        ->check(CLI::Range(1, 1024))
        ->type_name("N");
    command.add_flag("--no-flip", noFlip, "leave FLIP out, which takes most of the time");
    bars.addTo(command);
}

reference::MetricOptions ComparisonOptions::metricOptions() const {
    if (noFlip && bars.needFlip())
        throw Error(ErrorKind::Usage, "--no-flip: a bar for FLIP is set; one of the two would be right");
    reference::MetricOptions options = metrics;
    options.flip = !noFlip;
    return options;
}

ordered_json metricsJson(const Metrics& m, bool withFlip, bool withHalves) {
    ordered_json json;
    json["pixels"] = m.pixels;
    json["bad_pixels"] = m.badPixels;
    const auto add = [&](const char* key, double value) { json[key] = numberOrNull(value); };
    add("mean", m.mean);
    add("reference_mean", m.referenceMean);
    add("bias", m.bias);
    add("mae", m.mae);
    add("mse", m.mse);
    add("rmse", m.rmse);
    add("relrmse", m.relRmse);
    json["block_size"] = m.blockSize;
    add("block_relrmse", m.blockRelRmse);
    add("relmse", m.relMse);
    add("psnr_db", m.psnr);
    add("ssim", m.ssim);
    if (withFlip) {
        add("flip", m.flip);
        add("hdr_flip", m.hdrFlip);
    }
    if (withHalves) {
        add("relrmse_low", m.relRmseLow);
        add("relrmse_high", m.relRmseHigh);
        add("reference_noise", m.referenceNoise);
    }
    return json;
}

std::string blocksText(const Metrics& m) { return fmt::format("{0}x{0}", m.blockSize); }

std::vector<MetricRow> metricRows(const Metrics& m, bool withFlip, bool withHalves) {
    const char* radiance = "W/(sr m2)";
    std::vector<MetricRow> rows = {
        {"mean", shown(m.mean), radiance, "of the test image"},
        {"reference mean", shown(m.referenceMean), radiance, "of the reference"},
        {"bias", shown(m.bias * 100, "{:+.3f}"), "%", "mean / reference mean - 1"},
        {"MAE", shown(m.mae), radiance, "mean absolute error"},
        {"MSE", shown(m.mse), "",
         withHalves ? "mean squared error, less the reference's noise" : "mean squared error"},
        {"RMSE", shown(m.rmse), radiance, "root of MSE"},
        {"relRMSE", shown(m.relRmse * 100, "{:.3f}"), "%", "RMSE / reference mean"},
        {"relRMSE " + blocksText(m), shown(m.blockRelRmse * 100, "{:.3f}"), "%",
         fmt::format("of means of blocks of {} pixels", blocksText(m))},
        {"relMSE", shown(m.relMse), "", "mean of squared error / (reference^2 + 0.01)"},
        {"PSNR", shown(m.psnr, "{:.2f}"), "dB", "as displayed"},
        {"SSIM", shown(m.ssim, "{:.4f}"), "", "as displayed; 1 = equal"},
    };
    if (withFlip) {
        rows.push_back({"FLIP", shown(m.flip, "{:.4f}"), "", "as displayed; 0 = no visible difference"});
        rows.push_back({"HDR-FLIP", shown(m.hdrFlip, "{:.4f}"), "", "worst over exposures"});
    }
    if (withHalves) {
        rows.push_back({"relRMSE within",
                        shown(m.relRmseLow * 100, "{:.2f}") + "-" + shown(m.relRmseHigh * 100, "{:.2f}"), "%",
                        "95 of 100 times, by the reference's noise"});
        rows.push_back({"reference noise", shown(m.referenceNoise * 100, "{:.3f}"), "%",
                        "relRMSE that the reference itself has left"});
    }
    return rows;
}

std::string alignedTable(const std::vector<MetricRow>& rows) {
    std::size_t name = 0, value = 0, unit = 0;
    for (const MetricRow& row : rows) {
        name = std::max(name, row.name.size());
        value = std::max(value, row.value.size());
        unit = std::max(unit, row.unit.size());
    }
    std::string table;
    for (const MetricRow& row : rows)
        table += fmt::format("{:<{}}  {:>{}}  {:<{}}  {}\n", row.name, name, row.value, value, row.unit, unit,
                             row.meaning);
    return table;
}

void requireBars(const std::string& what, const std::vector<std::string>& broken) {
    if (broken.empty()) return;
    std::string message = what + ": ";
    for (std::size_t i = 0; i < broken.size(); ++i) message += (i ? ", " : "") + broken[i];
    throw Error(ErrorKind::Runtime, message);
}

void writeComparisonJson(const std::string& file, const ordered_json& json) {
    if (file == "-")
        std::fputs((json.dump(2) + "\n").c_str(), stdout);
    else
        writeJson(file, json);
}

}  // namespace conelight::program
