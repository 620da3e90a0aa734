// SPDX-License-Identifier: MIT
#include <fmt/core.h>

#include <cmath>

#include "comparison.h"
#include "equal_time.h"
#include "table.h"

namespace conelight::program {
namespace {

using nlohmann::ordered_json;

std::string referenceSource(const ReferencePicture& reference) {
    std::string text = reference.origin;
    if (reference.samplesPerPixel > 0)
        text += fmt::format(", {} samples per pixel, noise {:.2g} %", reference.samplesPerPixel,
                            100 * reference.noise);
    return text;
}

std::vector<std::string> rowOf(const std::string& label, const EqualTimePicture& picture, double ratio,
                               bool withFlip) {
    const reference::Metrics& m = picture.metrics;
    std::vector<std::string> row = {
        label,
        picture.samplesPerPixel > 0 ? std::to_string(picture.samplesPerPixel) : "-",
        fmt::format("{:.2f}", picture.drawn.cpuSeconds),
        fmt::format("{:.2f}", ratio),
        percent(m.relRmse),
        fmt::format("{:.3g}", m.relMse),
        percent(m.bias)};
    if (withFlip) row.push_back(fmt::format("{:.3f}", m.flip));
    return row;
}

std::string verdict(const EqualTimeVariant& row) {
    const double factor = row.factor();
    const std::string other = row.denoised.metrics.relMse <= row.plain.metrics.relMse
                                  ? "the path tracer, denoised,"
                                  : "the path tracer";
    if (factor > 1)
        return fmt::format("{}: least relMSE; {} has {:.3g} times as much", row.variant.label(), other,
                           factor);
    return fmt::format("{}: loses; {} has the least relMSE, {:.3g} times less", row.variant.label(), other,
                       1 / factor);
}

ordered_json pictureJson(const EqualTimePicture& picture, double ratio, bool withFlip, bool withHalves) {
    return {{"samples_per_pixel", picture.samplesPerPixel},
            {"cpu_seconds", picture.drawn.cpuSeconds},
            {"ratio", ratio},
            {"command", picture.drawn.command},
            {"components", {{"full", metricsJson(picture.metrics, withFlip, withHalves)}}}};
}

}  // namespace

void printEqualTime(const EqualTimeScene& result, bool withFlip) {
    fmt::print("{}  {} x {}  at equal CPU time, against: {}\n", result.scene, result.size.width,
               result.size.height, referenceSource(result.reference));
    std::vector<std::string> head = {"picture", "samples", "CPU s", "ratio", "relRMSE", "relMSE", "bias"};
    if (withFlip) head.emplace_back("FLIP");
    Table table(head);
    for (const EqualTimeVariant& row : result.variants) {
        table.add(rowOf(row.variant.label(), row.mode, 1, withFlip));
        table.add(rowOf("  path tracer", row.plain, row.ratio(row.plain), withFlip));
        table.add(rowOf("  path tracer, denoised", row.denoised, row.ratio(row.denoised), withFlip));
    }
    table.print();
    for (const EqualTimeVariant& row : result.variants) fmt::print("{}\n", verdict(row));
}

ordered_json equalTimeJson(const EqualTimeScene& result, bool withFlip) {
    ordered_json json = {{"scene", result.scene},
                         {"against", "reference"},
                         {"size", {result.size.width, result.size.height}},
                         {"reference", {{"origin", result.reference.origin}}}};
    if (result.reference.samplesPerPixel > 0)
        json["reference"].update({{"samples_per_pixel", result.reference.samplesPerPixel},
                                  {"noise", result.reference.noise},
                                  {"cpu_seconds", result.reference.cpuSeconds}});
    json["variants"] = ordered_json::array();
    for (const EqualTimeVariant& row : result.variants) {
        ordered_json one = {{"mode", row.variant.mode}, {"label", row.variant.label()}};
        one["settings"] = ordered_json::object();
        for (const auto& [key, value] : row.variant.values) one["settings"][key] = value;
        one["components"]["full"] = metricsJson(row.mode.metrics, withFlip, result.withHalves);
        const double plain = row.plain.metrics.relMse, denoised = row.denoised.metrics.relMse;
        const double factor = row.factor();
        one["equal_time"] = {
            {"cpu_seconds", row.mode.drawn.cpuSeconds},
            {"command", row.mode.drawn.command},
            {"path_tracer", pictureJson(row.plain, row.ratio(row.plain), withFlip, result.withHalves)},
            {"denoised", pictureJson(row.denoised, row.ratio(row.denoised), withFlip, result.withHalves)},
            {"least_relmse", factor > 1          ? "mode"
                             : denoised <= plain ? "denoised"
                                                 : "path_tracer"},
            {"factor", std::isfinite(factor) ? ordered_json(factor) : ordered_json()}};
        json["variants"].push_back(one);
    }
    return json;
}

}  // namespace conelight::program
