// SPDX-License-Identifier: MIT
// `conelight score shift`: how much of a picture comes from where the voxel grid happens to lie.
#include <fmt/core.h>

#include <cmath>

#include "reference/scores.h"
#include "score.h"

namespace conelight::program {
namespace {

struct ShiftOptions : ScoreOptions {
    int count = 4;
};

// The k-th point of the additive sequence with the plastic numbers' inverse powers in three dimensions
// (Roberts 2018, R3): few points fill the cube evenly.
glm::vec3 shiftAt(int k) {
    const glm::dvec3 p = 0.5 + static_cast<double>(k) * glm::dvec3(0.8191725134, 0.6710436067, 0.5497004779);
    return glm::vec3(p - glm::floor(p));
}

struct Change {
    double mean = 0, worst = 0;
    glm::vec3 worstShift{0};
};

// The change of each of the request's components over all shifts.
std::vector<Change> changesOf(PictureSource& source, PictureRequest request, int count, Progress& progress) {
    const std::vector<Image> still = source.draw(request, &progress).images;
    std::vector<Change> changes(still.size());
    for (int k = 1; k <= count; ++k) {
        request.settings.voxels.shift = shiftAt(k);
        const std::vector<Image> moved = source.draw(request, &progress).images;
        for (std::size_t i = 0; i < moved.size(); ++i) {
            const double change = reference::relativeDifference(moved[i], still[i]);
            changes[i].mean += change / count;
            if (!(change <= changes[i].worst)) {
                changes[i].worst = change;
                changes[i].worstShift = request.settings.voxels.shift;
            }
        }
    }
    return changes;
}

void run(const ShiftOptions& options) {
    const std::vector<Variant> variants = options.checked("shift", true);
    PictureSource source(options.view);
    ScoreReport report("shift", "RMS of the change / mean radiance", options);
    Table table({"scene", "mode", "full, mean", "worst", "indirect, mean", "worst", "worst shift, voxels"});
    Progress progress;
    for (const std::string& path : options.scenes) {
        const Scene scene = openScene(path, options.view, progress);
        source.setScene(scene);
        for (const Variant& variant : variants) {
            PictureRequest request = requestOf(variant, scene, options.view);
            request.components = {Component::Full, Component::Indirect};
            const std::vector<Change> changes = changesOf(source, request, options.count, progress);
            const Change &full = changes[0], &indirect = changes[1];
            const glm::vec3 at = full.worstShift;
            table.add({path, variant.label(), percent(full.mean), percent(full.worst), percent(indirect.mean),
                       percent(indirect.worst), fmt::format("{:.2f},{:.2f},{:.2f}", at.x, at.y, at.z)});
            report.add(path + " " + variant.label(), full.worst,
                       {{"scene", path},
                        {"variant", variant.label()},
                        {"shifts", options.count},
                        {"full", {{"mean", full.mean}, {"worst", full.worst}}},
                        {"indirect", {{"mean", indirect.mean}, {"worst", indirect.worst}}},
                        {"worst_shift", {at.x, at.y, at.z}}});
        }
    }
    progress.finish();
    table.print(2);
    report.finish(source.device());
}

}  // namespace

void addScoreShift(CLI::App& score) {
    auto options = std::make_shared<ShiftOptions>();
    CLI::App* command =
        score.add_subcommand("shift", "change of the picture when the grid moves by parts of a voxel");
    command->add_option("scenes", options->scenes, "scene files or builtin:NAME")->required();
    command->add_option("--shifts", options->count, "places of the grid that are tried")
        ->capture_default_str()
        ->check(CLI::Range(1, 64));
    options->addTo(*command, "cones", "256x256");
    command->callback([options] { run(*options); });
}

}  // namespace conelight::program
