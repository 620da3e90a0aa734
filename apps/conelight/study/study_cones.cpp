// SPDX-License-Identifier: MIT
// `conelight study cones`: which directions, apertures and weights gather indirect light best, for 4 to 16
// cones, over many scenes, each held out in turn.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <numbers>

#include "conelight/error.h"
#include "io/cone_set_file.h"
#include "outputs.h"
#include "stats_json.h"
#include "study/cone_pictures.h"
#include "study/study.h"
#include "table.h"

namespace conelight::program {
namespace {

using reference::Ring;
using reference::SceneFit;

struct ConeStudyOptions {
    std::vector<std::string> scenes;
    std::string counts = "4,5,6,7,8,9,10,12,14,16";
    ViewOptions view;
    int samples = 256;
    std::uint32_t seed = 1;
    std::string directory, jsonFile;
    bool coarse = false, markdown = false;
};

constexpr const char* kScenes[] = {"builtin:cornell-point", "builtin:colours", "builtin:study",
                                   "builtin:clutter",       "builtin:lobby",   "builtin:sunroom",
                                   "builtin:parlour",       "builtin:garden",  "builtin:thesis-complex"};

// All rings that are tried: tilts and apertures in even steps.
std::vector<Ring> candidates(bool coarse) {
    std::vector<Ring> rings;
    const int step = coarse ? 2 : 1;
    constexpr double kDegree = std::numbers::pi / 180;
    for (int a = 0; a < 6; a += step) rings.push_back({1, 0.0f, 0.4f + 0.3f * float(a)});
    for (int cones = 3; cones <= 8; ++cones)
        for (int tilt = 15; tilt <= 80; tilt += 5 * step)
            for (int a = 0; a < 7; a += step)
                rings.push_back({cones, float(tilt * kDegree), 0.25f + 0.2f * float(a)});
    return rings;
}

// The thesis's sets: one cone in front, four at 45 degrees, four along the surface, equal, 0.55 rad wide.
std::vector<SetCone> thesisSet(int cones) {
    constexpr float kAperture = 0.55f;
    std::vector<SetCone> set = conesOf(Ring{1, 0.0f, kAperture});
    for (const auto& [least, tilt] : {std::pair(5, 0.25), std::pair(9, 0.5)}) {
        if (cones < least) continue;
        const std::vector<SetCone> ring = conesOf(Ring{4, float(tilt * std::numbers::pi), kAperture}, 0);
        set.insert(set.end(), ring.begin(), ring.end());
    }
    return set;
}

std::vector<SetCone> conesOf(const std::vector<SceneFit::Share>& shares, const std::vector<Ring>& rings) {
    std::vector<SetCone> set;
    double turn = 0.25;  // each ring looks between the cones of the one inside it
    for (const SceneFit::Share& share : shares) {
        const Ring& ring = rings[share.ring];
        for (SetCone cone : reference::conesOf(ring, turn)) {
            cone.weight = float(share.weight * std::numbers::pi / ring.cones);
            set.push_back(cone);
        }
        if (ring.cones > 1) turn += 0.5;
    }
    return set;
}

std::string textOf(const std::vector<SceneFit::Share>& shares, const std::vector<Ring>& rings) {
    std::string text;
    for (const SceneFit::Share& share : shares) {
        const Ring& ring = rings[share.ring];
        text += fmt::format("{}{} at {:.0f} deg, {:.2f} rad, {:.2f}", text.empty() ? "" : "; ", ring.cones,
                            double(ring.tilt) * 180 / std::numbers::pi, double(ring.aperture), share.weight);
    }
    return text;
}

// One set over all scenes.
struct Row {
    std::string name, text;
    int cones = 0;
    std::vector<double> relRmse;  // per scene
    double samples = 0;           // per pixel, mean over scenes
    double heldOut = -1;  // mean over scenes of the ratio to six cones, each scene left out of the search
    std::vector<SetCone> set;  // empty: by name
};

struct SceneData {
    std::string path;
    Image truthA, truthB;
    SceneFit fit;
};

double relRmseOf(const Image& picture, const SceneData& scene) {
    const SceneFit fit(std::span(&picture, 1), scene.truthA, scene.truthB);
    const SceneFit::Share all{0, 1.0};
    return std::sqrt(std::max(fit.relMse(std::span(&all, 1)), 0.0));
}

class ConeStudy {
  public:
    explicit ConeStudy(const ConeStudyOptions& options)
        : options_(options), rings_(candidates(options.coarse)), source_(options.view) {
        for (const std::string& word : splitList(options.counts)) {
            const double count = parseNumber("--counts", word);
            if (count != std::floor(count) || count < 4 || count > 17)
                usage("--counts: " + word + " is not usable; numbers from 4 to 17 would be right");
            counts_.push_back(int(count));
        }
        fixedRows();
    }

    void run() {
        for (const std::string& path : options_.scenes) measure(path);
        search();
        // What was found is drawn, not predicted.
        for (std::size_t s = 0; s < scenes_.size(); ++s) drawFound(s);
        progress_.finish();
        print();
        write();
    }

  private:
    void fixedRows() {
        for (const int n : {1, 5, 9})
            rows_.push_back({fmt::format("thesis {}", n), "equal weights", n, {}, 0, -1, thesisSet(n)});
        const std::pair<DiffuseSet, int> named[] = {
            {DiffuseSet::One, 1}, {DiffuseSet::Five, 5}, {DiffuseSet::Six, 6}, {DiffuseSet::Nine, 9}};
        for (const auto& [set, n] : named) {
            rows_.push_back({fmt::format("derived {}", n), "equal solid angles", n, {}, 0, -1, {}});
            sets_.push_back({set, n});
        }
        for (const int n : {4, 8, 16}) {
            rows_.push_back({fmt::format("fibonacci {}", n), "equal solid angles", n, {}, 0, -1, {}});
            sets_.push_back({DiffuseSet::Fibonacci, n});
        }
    }

    void measure(const std::string& path) {
        const Scene scene = openScene(path, options_.view, progress_);
        ConePictures pictures(source_, scene, options_.view, progress_);
        auto [truthA, truthB] = pictures.truth(options_.samples, options_.seed);
        std::vector<Image> byRing;
        for (std::size_t i = 0; i < rings_.size(); ++i) {
            progress_.show(fmt::format("{}: ring {} of {}", path, i + 1, rings_.size()));
            byRing.push_back(pictures.by(reference::conesOf(rings_[i])).image);
        }
        SceneFit fit(byRing, truthA, truthB);
        scenes_.push_back({path, std::move(truthA), std::move(truthB), std::move(fit)});
        std::size_t named = 0;
        for (Row& row : rows_) {
            const auto drawn = row.set.empty() ? pictures.by(sets_[named].first, sets_[named].second)
                                               : pictures.by(row.set, true);
            if (row.set.empty()) ++named;
            add(row, drawn, scenes_.back());
        }
    }

    void add(Row& row, const ConePicture& drawn, const SceneData& scene) {
        row.relRmse.push_back(relRmseOf(drawn.image, scene));
        row.samples += drawn.samples / double(options_.scenes.size());
    }

    // Errors of the set of six are the unit, so that no scene outweighs the others.
    std::vector<double> scales() const {
        std::vector<double> scales;
        for (const double error : sixCones().relRmse) scales.push_back(1 / std::max(error * error, 1e-12));
        return scales;
    }
    const Row& sixCones() const {
        for (const Row& row : rows_)
            if (row.name == "derived 6") return row;
        throw Error(ErrorKind::Runtime, "study cones: the set of six is missing");
    }

    void search() {
        std::vector<SceneFit> fits;
        for (const SceneData& scene : scenes_) fits.push_back(scene.fit);
        const std::vector<double> all = scales();
        for (const int n : counts_) {
            progress_.show(fmt::format("search: {} cones", n));
            const reference::FoundSet best = bestSet(rings_, fits, all, n);
            if (best.shares.empty()) continue;
            Row row{fmt::format("found {}", n),  textOf(best.shares, rings_), n, {}, 0, -1,
                    conesOf(best.shares, rings_)};
            if (fits.size() > 1) row.heldOut = heldOut(fits, all, n);
            rows_.push_back(std::move(row));
        }
    }

    // Each scene judged by the set that the others choose: mean ratio of relRMSE to six cones.
    double heldOut(const std::vector<SceneFit>& fits, const std::vector<double>& all, int cones) const {
        double sum = 0;
        for (std::size_t s = 0; s < fits.size(); ++s) {
            std::vector<double> others = all;
            others[s] = 0;
            const reference::FoundSet best = bestSet(rings_, fits, others, cones);
            sum += std::sqrt(std::max(fits[s].relMse(best.shares) * all[s], 0.0)) / double(fits.size());
        }
        return sum;
    }

    void drawFound(std::size_t s) {
        const Scene scene = openScene(scenes_[s].path, options_.view, progress_);
        ConePictures pictures(source_, scene, options_.view, progress_);
        for (Row& row : rows_)
            if (row.relRmse.size() == s) add(row, pictures.by(row.set, true), scenes_[s]);
    }

    double ratioToSix(const Row& row) const {
        double sum = 0;
        for (std::size_t s = 0; s < row.relRmse.size(); ++s)
            sum += row.relRmse[s] / std::max(sixCones().relRmse[s], 1e-6);
        return sum / double(row.relRmse.size());
    }

    static std::vector<std::string> head() {
        return {"set", "cones", "samples", "error / six", "held out", "rings: tilt, aperture, weight"};
    }
    std::vector<std::string> cells(const Row& row) const {
        return {row.name,
                std::to_string(row.cones),
                number(row.samples),
                number(ratioToSix(row)),
                row.heldOut < 0 ? "" : number(row.heldOut),
                row.text};
    }

    void print() const {
        if (options_.markdown) {
            fmt::print("| {} |\n|---|--:|--:|--:|--:|---|\n", fmt::join(head(), " | "));
            for (const Row& row : rows_) fmt::print("| {} |\n", fmt::join(cells(row), " | "));
            return;
        }
        Table table(head());
        for (const Row& row : rows_) table.add(cells(row));
        table.print(1);
    }

    void write() const {
        if (!options_.directory.empty()) {
            std::filesystem::create_directories(options_.directory);
            for (const Row& row : rows_)
                if (row.name.starts_with("found"))
                    io::writeConeSet(fmt::format("{}/found_{}.json", options_.directory, row.cones), row.set);
        }
        if (options_.jsonFile.empty()) return;
        nlohmann::ordered_json json{{"version", 1},
                                    {"study", "cones"},
                                    {"device", source_.device()},
                                    {"size", options_.view.size},
                                    {"reference_samples", 2 * options_.samples},
                                    {"scenes", options_.scenes},
                                    {"sets", nlohmann::ordered_json::array()}};
        for (const Row& row : rows_) {
            nlohmann::ordered_json one{{"name", row.name},        {"cones", row.cones},
                                       {"rings", row.text},       {"samples_per_pixel", row.samples},
                                       {"rel_rmse", row.relRmse}, {"ratio_to_six", ratioToSix(row)}};
            if (row.heldOut >= 0) one["held_out_ratio_to_six"] = row.heldOut;
            json["sets"].push_back(std::move(one));
        }
        writeJson(options_.jsonFile, json);
    }

    const ConeStudyOptions& options_;
    std::vector<int> counts_;
    std::vector<Ring> rings_;
    PictureSource source_;
    Progress progress_;
    std::vector<SceneData> scenes_;
    std::vector<Row> rows_;
    std::vector<std::pair<DiffuseSet, int>> sets_;  // of the rows without cones of their own, in their order
};

void run(ConeStudyOptions& options) {
    if (options.scenes.empty()) options.scenes.assign(std::begin(kScenes), std::end(kScenes));
    parseSize(options.view.size);
    checkOutputs({{"--json", options.jsonFile, OutputKind::Json}}, options.scenes);
    ConeStudy(options).run();
}

}  // namespace

void addStudyCones(CLI::App& study) {
    auto options = std::make_shared<ConeStudyOptions>();
    options->view.size = "96x72";
    CLI::App* command = study.add_subcommand(
        "cones", "directions, apertures and weights of the diffuse cones with the least error");
    command->add_option("scenes", options->scenes, "scene files or builtin:NAME (default: nine of ours)");
    command->add_option("--counts", options->counts, "numbers of cones")->capture_default_str();
    command->add_flag("--coarse", options->coarse, "a quarter of the rings");
    command->add_flag("--markdown", options->markdown, "the table as Markdown");
    command->add_option("--spp", options->samples, "of each of two reference pictures")
        ->capture_default_str()
        ->check(CLI::Range(2, 1 << 20));
    command->add_option("--seed", options->seed, "of the reference")->capture_default_str();
    command->add_option("-o,--output", options->directory, "write the sets that were found here")
        ->type_name("DIR");
    command->add_option("--json", options->jsonFile, "write the figures as JSON")->type_name("FILE");
    options->view.addTo(*command);
    command->callback([options] { run(*options); });
}

}  // namespace conelight::program
