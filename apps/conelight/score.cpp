// SPDX-License-Identifier: MIT
// `conelight score leak|shift|flicker|convergence|edges`: faults that one picture does not show, as numbers.
#include "score.h"

#include <fmt/core.h>

#include <cmath>

#include "conelight/error.h"
#include "outputs.h"
#include "stats_json.h"

namespace conelight::program {

void ScoreOptions::addTo(CLI::App& command, const std::string& defaultModes, const std::string& defaultSize) {
    view.size = defaultSize;
    variants.addTo(command, defaultModes);
    command.add_option("--max", most, "end with status 1 when a score is above")
        ->type_name("X")
        ->check(CLI::NonNegativeNumber);
    command.add_option("--json", jsonFile, "write the figures as JSON")->type_name("FILE");
    view.addTo(command);
}

std::vector<Variant> ScoreOptions::checked(const char* score, bool rendererModesOnly) const {
    parseSize(view.size);
    std::vector<Variant> all = variants.variants();
    for (const Variant& variant : all)
        if (rendererModesOnly && !isRendererMode(variant.mode))
            throw Error(ErrorKind::Usage, fmt::format("score {}: mode {} has nothing that could be wrong "
                                                      "here; phong, thesis or cones would be right",
                                                      score, variant.mode));
    std::vector<std::string> inputs = scenes;
    inputs.insert(inputs.end(), {view.preset, view.environment});
    checkOutputs({{"--json", jsonFile, OutputKind::Json}}, inputs);
    return all;
}

ScoreReport::ScoreReport(std::string score, std::string unit, const ScoreOptions& options)
    : score_(std::move(score)), options_(options) {
    json_["version"] = 1;
    json_["score"] = score_;
    json_["unit"] = std::move(unit);
    json_["device"] = nullptr;
    json_["size"] = {parseSize(options.view.size).width, parseSize(options.view.size).height};
    json_["runs"] = nlohmann::ordered_json::array();
}

PictureRequest requestOf(const Variant& variant, const Scene& scene, const ViewOptions& view) {
    PictureRequest request;
    request.mode = variant.mode;
    request.settings = variant.settingsFor(scene, view);
    request.camera = cameraFor(scene, view);
    request.size = parseSize(view.size);
    return request;
}

void ScoreReport::add(const std::string& what, double value, nlohmann::ordered_json json) {
    ++count_;
    json_["runs"].push_back(std::move(json));
    if (options_.most >= 0 && !(value <= options_.most)) ++tooHigh_;
    if (worst_.empty() || !(value <= worstValue_)) {
        worst_ = what;
        worstValue_ = value;
    }
}

void ScoreReport::finish(const std::string& device) {
    if (!device.empty()) json_["device"] = device;
    if (!options_.jsonFile.empty()) writeJson(options_.jsonFile, json_);
    if (tooHigh_ > 0)
        throw Error(ErrorKind::Runtime,
                    fmt::format("score {}: {} of {} above {}; the highest is {}, {}", score_, tooHigh_,
                                count_, number(options_.most), number(worstValue_), worst_));
}

void addScore(CLI::App& app) {
    CLI::App* score = app.add_subcommand("score", "faults that one picture does not show, as numbers");
    score->require_subcommand(1);
    addScoreLeak(*score);
    addScoreShift(*score);
    addScoreFlicker(*score);
    addScoreConvergence(*score);
    addScoreEdges(*score);
}

}  // namespace conelight::program
