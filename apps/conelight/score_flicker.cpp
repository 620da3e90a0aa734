// SPDX-License-Identifier: MIT
// `conelight score flicker`: error that comes and goes along a path of the camera, of an object, of a light or of the day.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "conelight/error.h"
#include "reference/metrics.h"
#include "reference/scores.h"
#include "reference_file.h"
#include "score.h"
#include "score_path.h"

namespace conelight::program {
namespace {

struct FlickerOptions : ScoreOptions {
    std::string path = "orbit=4";
    int frames = 8;
    int stations = 0;  // 0: all inner frames
    std::string components = "indirect";
    std::string cache;
    TracerOptions tracer;
};

// The inner frames that are compared with the path tracer, in even steps from the first to the last.
std::vector<std::size_t> stationsOf(const FlickerOptions& options) {
    const int inner = options.frames - 2, count = options.stations > 0 ? options.stations : inner;
    std::vector<std::size_t> stations;
    for (int i = 0; i < count; ++i)
        stations.push_back(
            1 + static_cast<std::size_t>(std::lround(double(i) * (inner - 1) / std::max(count - 1, 1))));
    return stations;
}

// How far a variant is from the path tracer at the stations.
struct StationErrors {
    std::vector<reference::Metrics> each;

    double block() const {  // root mean square
        double squares = 0;
        for (const reference::Metrics& one : each) squares += one.blockRelRmse * one.blockRelRmse;
        return std::sqrt(squares / static_cast<double>(each.size()));
    }
    double bias() const {  // mean
        double sum = 0;
        for (const reference::Metrics& one : each) sum += one.bias;
        return sum / static_cast<double>(each.size());
    }
};

// All frames of one scene: references at the stations and beside them, and depth, first; then each variant's pictures in
// its own renderer.
struct Flicker {
    const FlickerOptions& options;
    const Scene& scene;
    Progress& progress;
    const ScorePath path;
    const std::vector<std::size_t> stations;
    std::vector<reference::FlickerFrame> frames = {};
    std::map<std::size_t, ReferencePicture> truths = {};
    int samples = 0;

    PictureRequest requestAt(std::size_t f) const {
        PictureRequest request;
        request.size = parseSize(options.view.size);
        request.camera = path.cameraAt(cameraFor(scene, options.view), static_cast<int>(f), options.frames);
        request.reference = options.tracer.settings();
        return request;
    }
    bool isNearStation(std::size_t f) const {
        return std::any_of(stations.begin(), stations.end(),
                           [f](std::size_t s) { return f + 1 >= s && f <= s + 1; });
    }

    // The scene of the frame, in the source; frames in order.
    const Scene& show(PictureSource& source, SceneAlong& along, std::size_t f) const {
        const Scene& now = along.at(static_cast<int>(f));
        if (f == 0)
            source.setScene(now);
        else if (path.movesScene())
            source.changeScene(now);
        return now;
    }

    void prepare() {
        PictureSource source(options.view);
        SceneAlong along(path, scene, options.frames);
        for (std::size_t f = 0; f < static_cast<std::size_t>(options.frames); ++f) {
            const Scene& now = show(source, along, f);
            PictureRequest request = requestAt(f);
            progress.show(fmt::format("reference of frame {} of {}", f + 1, options.frames));
            if (isNearStation(f)) {
                truths[f] = referenceFor(source, now, request, options.cache, "flicker", &progress);
                samples = truths[f].samplesPerPixel;
            }
            request.components = {Component::Depth};
            reference::FlickerFrame frame;
            frame.camera = request.camera;
            frame.depth = source.draw(request, &progress).images.front();
            frames.push_back(std::move(frame));
        }
    }

    // In order, as an animation that starts settled: what a mode keeps over frames takes part.
    std::string draw(const Variant& variant, Component component) {
        PictureSource source(options.view);
        SceneAlong along(path, scene, options.frames);
        for (std::size_t f = 0; f < frames.size(); ++f) {
            progress.show(fmt::format("{}: frame {} of {}", variant.label(), f + 1, frames.size()));
            const Scene& now = show(source, along, f);
            PictureRequest request = requestAt(f);
            request.mode = variant.mode;
            request.settings = variant.settingsFor(now, options.view);
            request.components = {component};
            request.settings.traced.budgeted = f > 0;
            frames[f].test = source.draw(request, nullptr).images.front();
            const auto truth = truths.find(f);
            if (truth == truths.end()) continue;
            const bool all = component == Component::Full;
            frames[f].halfA = all ? truth->second.halfA : truth->second.indirectA;
            frames[f].halfB = all ? truth->second.halfB : truth->second.indirectB;
        }
        return source.device();
    }

    StationErrors errors(Component component) const {
        StationErrors errors;
        for (const std::size_t s : stations) {
            reference::MetricOptions how;
            how.flip = false;
            errors.each.push_back(
                reference::compareImages(frames[s].test, *truths.at(s).part(component), how,
                                         reference::Halves{&frames[s].halfA, &frames[s].halfB}));
        }
        return errors;
    }
};

nlohmann::ordered_json stationsJson(const Flicker& flicker, const StationErrors& errors) {
    nlohmann::ordered_json json = nlohmann::ordered_json::array();
    for (std::size_t i = 0; i < flicker.stations.size(); ++i) {
        const glm::vec3 eye = flicker.frames[flicker.stations[i]].camera.eye;
        const reference::Metrics& one = errors.each[i];
        json.push_back({{"frame", flicker.stations[i]},
                        {"eye", {eye.x, eye.y, eye.z}},
                        {"rel_rmse", one.relRmse},
                        {"block_rel_rmse", one.blockRelRmse},
                        {"bias", one.bias},
                        {"reference_mean", one.referenceMean},
                        {"reference_noise", one.referenceNoise}});
    }
    return json;
}

// What was found, on its way to both tables and the report.
struct FlickerTables {
    Table all{{"scene", "mode", "component", "flicker", "noise floor", "worst frame", "jump", "4x4", "bias",
               "pixels followed", "reference"}};
    Table stations{{"mode", "component", "frame", "eye", "relRMSE", "4x4", "bias", "reference's noise"}};
};

// One component of one variant, drawn and judged.
std::string score(Flicker& flicker, const std::string& name, const Variant& variant,
                  const std::string& component, FlickerTables& tables, ScoreReport& report) {
    const std::string device = flicker.draw(variant, componentOf(component));
    const reference::FlickerScore score = reference::flickerScore(flicker.frames, flicker.stations);
    const StationErrors errors = flicker.errors(componentOf(component));
    const std::vector<double> unsteady = reference::unsteadiness(flicker.frames);
    const reference::Jump jump = reference::jumpOf(unsteady);
    const double worst = *std::max_element(score.each.begin(), score.each.end());
    tables.all.add({name, variant.label(), component, percent(score.flicker), percent(score.floor),
                    percent(worst), fmt::format("{:.1f} x at {}", jump.ratio, jump.frame),
                    percent(errors.block()), percent(errors.bias()), percent(score.pixelsUsed),
                    fmt::format("{} spp", flicker.samples)});
    for (std::size_t i = 0; i < flicker.stations.size(); ++i) {
        const glm::vec3 eye = flicker.frames[flicker.stations[i]].camera.eye;
        const reference::Metrics& one = errors.each[i];
        tables.stations.add({variant.label(), component, std::to_string(flicker.stations[i]),
                             fmt::format("{:.2f},{:.2f},{:.2f}", eye.x, eye.y, eye.z), percent(one.relRmse),
                             percent(one.blockRelRmse), percent(one.bias), percent(one.referenceNoise)});
    }
    report.add(name + " " + variant.label(), score.flicker,
               {{"scene", name},
                {"variant", variant.label()},
                {"path", flicker.options.path},
                {"component", component},
                {"frames", flicker.options.frames},
                {"flicker", score.flicker},
                {"noise_floor", score.floor},
                {"each", score.each},
                {"pixels_followed", score.pixelsUsed},
                {"jump", {{"ratio", jump.ratio}, {"frame", jump.frame}}},
                {"unsteadiness", unsteady},
                {"block_rel_rmse", errors.block()},
                {"bias", errors.bias()},
                {"stations", stationsJson(flicker, errors)},
                {"reference_mean", score.mean},
                {"reference_samples_per_pixel", flicker.samples}});
    return device;
}

void run(const FlickerOptions& options) {
    const std::vector<Variant> variants = options.checked("flicker", false);
    const std::vector<std::string> components = splitList(options.components);
    for (const std::string& component : components)
        if (component != "full" && component != "indirect")
            throw Error(ErrorKind::Usage,
                        "--component: '" + component + "' is not usable; full or indirect would be right");
    if (options.stations > options.frames - 2)
        throw Error(ErrorKind::Usage, fmt::format("--stations: {} are more than the {} frames that have "
                                                  "neighbours; fewer, or more --frames, would be right",
                                                  options.stations, options.frames - 2));
    for (const std::string& name : options.scenes) ScorePath(options.path, name, options.view);
    ScoreReport report("flicker", "high-pass error / mean radiance of the reference", options);
    FlickerTables tables;
    Progress progress;
    std::string device;
    for (const std::string& name : options.scenes) {
        ScorePath path(options.path, name, options.view);
        const Scene scene =
            openScene(name, options.view, progress, path.animation(), path.animation() != nullptr);
        Flicker flicker{options, scene, progress, path, stationsOf(options)};
        flicker.prepare();
        for (const Variant& variant : variants)
            for (const std::string& component : components)
                device = score(flicker, name, variant, component, tables, report);
    }
    progress.finish();
    tables.all.print(3);
    if (options.stations > 0) {
        fmt::print("\n");
        tables.stations.print(2);
    }
    report.finish(device);
}

}  // namespace

void addScoreFlicker(CLI::App& score) {
    auto options = std::make_shared<FlickerOptions>();
    CLI::App* command = score.add_subcommand(
        "flicker",
        "error that comes and goes along a path of the camera, of an object, of a light or of the day");
    command->add_option("scenes", options->scenes, "scene files or builtin:NAME")->required();
    command
        ->add_option("--path", options->path,
                     "orbit=DEGREES about the target, dolly=PART of the way to it, object=NAME:X,Y,Z in m, "
                     "light=NAME:X,Y,Z in m, dim=NAME:PART in each second frame, clip=NAME of the scene, or "
                     "the file of a camera path "
                     "(docs/reference/camera_path.md)")
        ->capture_default_str()
        ->type_name("PATH");
    command->add_option("--frames", options->frames, "along the path")
        ->capture_default_str()
        ->check(CLI::Range(3, 10000));
    command
        ->add_option("--stations", options->stations,
                     "so many frames, and their neighbours, are path-traced; all are drawn (default: all)")
        ->check(CLI::Range(1, 10000));
    command->add_option("--component", options->components, "full, indirect or both, comma-separated")
        ->capture_default_str();
    command->add_option("--cache", options->cache, "folder in which reference pictures are kept")
        ->type_name("DIR");
    options->tracer.addTo(
        *command,
        "mode reference: center (a point per pixel, as the other modes; the default) or box "
        "(its area)");
    options->addTo(*command, "cones", "160x120");
    command->callback([options] { run(*options); });
}

}  // namespace conelight::program
