// SPDX-License-Identifier: MIT
// `conelight bake SCENE -o DIR`: light probes for other programs, and how wrong a picture lit by them is.
#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "command.h"
#include "io/files.h"
#include "io/image_file.h"
#include "io/probe_files.h"
#include "memory_limit.h"
#include "picture_file.h"
#include "reference/metrics.h"
#include "reference/path_tracer.h"
#include "reference/probes.h"
#include "table.h"
#include "truth_options.h"

namespace conelight::program {
namespace {

struct BakeOptions {
    std::string scene, out, json, picture, checkSize = "128x96";
    double spacing = 0;
    int samples = 1024, checkSamples = 512;
    std::string bounces = "all";
    std::uint32_t seed = 1;
    bool force = false, noCheck = false;
    ViewOptions view;
};

io::ProbeFiles filesOf(const reference::ProbeVolume& volume, const BakeOptions& options) {
    io::ProbeFiles files;
    files.scene = options.scene;
    files.origin = volume.grid.origin;
    files.spacing = volume.grid.spacing;
    files.counts = volume.grid.counts;
    files.irradianceSide = reference::kIrradianceSide;
    files.distanceSide = reference::kDistanceSide;
    files.samples = options.samples;
    files.seed = options.seed;
    for (const reference::Probe& probe : volume.probes) {
        files.probes.push_back({probe.position, probe.active, probe.harmonics});
        files.irradiance.insert(files.irradiance.end(), probe.irradiance.begin(), probe.irradiance.end());
        files.distance.insert(files.distance.end(), probe.distance.begin(), probe.distance.end());
    }
    return files;
}

// The table, and the same for --json.
nlohmann::ordered_json printErrors(const Scene& scene, const reference::ProbeVolume& volume,
                                   const Camera& camera, const reference::PathTracedPicture& truth) {
    reference::MetricOptions numbers;
    numbers.flip = false;
    Table table({"probes", "diffuse indirect", "bias", "whole picture", "bias"});
    nlohmann::ordered_json json = nlohmann::ordered_json::array();
    for (const auto& [name, kind] : {std::pair{"sh", reference::ProbeKind::Harmonics},
                                     std::pair{"octahedral", reference::ProbeKind::Octahedral}}) {
        const reference::ProbePicture picture = drawWithProbes(scene, volume, kind, camera, truth);
        const reference::Metrics diffuse = compareImages(picture.diffuse, truth.diffuse, numbers);
        const reference::Metrics full = compareImages(picture.full, truth.full, numbers);
        table.add({name, percent(diffuse.relRmse), percent(diffuse.bias), percent(full.relRmse),
                   percent(full.bias)});
        json.push_back({{"kind", name},
                        {"diffuse_rel_rmse", diffuse.relRmse},
                        {"diffuse_bias", diffuse.bias},
                        {"full_rel_rmse", full.relRmse},
                        {"full_bias", full.bias}});
    }
    table.print(1);
    return json;
}

nlohmann::ordered_json check(const Scene& scene, const reference::ProbeVolume& volume,
                             const BakeOptions& options, Progress& progress) {
    const Size size = parseSize(options.checkSize);
    const Camera camera = cameraFor(scene, options.view);
    reference::PathTracerSettings settings;
    settings.samplesPerPixel = options.checkSamples;
    settings.bounces = parseBounces(options.bounces, 1000);
    settings.seed = options.seed + 1;  // independent of the probes
    const reference::PathTracer tracer(scene);
    const reference::PathTracedPicture truth =
        tracer.render(camera, size.width, size.height, settings, [&](const reference::PathTracerProgress& p) {
            progress.show(fmt::format("path tracing the check, {} of {}", p.samplesDone, p.samplesPlanned));
            return !interrupted();
        });
    progress.finish();
    if (interrupted()) throw InterruptedError();
    fmt::print("against the path tracer, {}x{}, {} samples, whose own noise counts as error:\n", size.width,
               size.height, options.checkSamples);
    if (!options.picture.empty())
        writePicture(options.picture,
                     drawWithProbes(scene, volume, reference::ProbeKind::Octahedral, camera, truth).full,
                     settingsFor(scene, "", options.view).image);
    return printErrors(scene, volume, camera, truth);
}

// Throws Error(Usage), before anything is written.
void checkOptions(const BakeOptions& options) {
    const Size size = parseSize(options.checkSize);
    if (options.spacing < 0)
        usage(fmt::format("--spacing: {} is not usable; a distance above 0 would be right", options.spacing));
    if (options.samples < 16 || options.samples > (1 << 20))
        usage(fmt::format("--samples: {} is not usable; 16 to 1048576 would be right", options.samples));
    if (parseBounces(options.bounces, 1000) == 0)
        usage("--bounces: 0 leaves no indirect light; 1 to 1000, or all, would be right");
    if (options.checkSamples < 1 || options.checkSamples > (1 << 20))
        usage(
            fmt::format("--check-spp: {} is not usable; 1 to 1048576 would be right", options.checkSamples));
    if (!options.picture.empty()) io::imageFormatOf(options.picture);
    if (size.width > 4096 || size.height > 4096)
        usage(
            fmt::format("--check-size: {} is too large; up to 4096x4096 would be right", options.checkSize));
}

void run(const BakeOptions& options) {
    checkOptions(options);
    for (const std::string& file : {options.json, options.picture})
        if (!file.empty()) io::refuseOverwriting(file, options.force);
    Progress progress;
    const Scene scene = openScene(options.scene, options.view, progress);
    const Aabb bounds = scene.bounds();
    const glm::vec3 extent = bounds.extent();
    const float longest = std::max({extent.x, extent.y, extent.z});
    const reference::ProbeGrid grid = reference::fitProbeGrid(
        bounds, options.spacing > 0 ? static_cast<float>(options.spacing) : longest / 8);
    reference::ProbeSettings settings;
    settings.samples = options.samples;
    settings.bounces = parseBounces(options.bounces, 1000);
    settings.seed = options.seed;
    io::checkProbeFolder(options.out, options.force);
    const StoppableScope stoppable;
    const HostMemoryLimit limit;
    const reference::ProbeVolume volume = reference::bakeProbes(scene, grid, settings, [&](double done) {
        progress.show(fmt::format("baking {} probes, {:.0f} %", grid.size(), 100 * done));
        return !interrupted();
    });
    progress.finish();
    if (interrupted()) throw InterruptedError();
    io::writeProbes(options.out, filesOf(volume, options), options.force);
    const auto active = std::count_if(volume.probes.begin(), volume.probes.end(),
                                      [](const reference::Probe& probe) { return probe.active; });
    fmt::print("written {}/probes.json: {} x {} x {} probes, {:.3g} x {:.3g} x {:.3g} m apart, {} in walls\n",
               options.out, grid.counts.x, grid.counts.y, grid.counts.z, grid.spacing.x, grid.spacing.y,
               grid.spacing.z, grid.size() - static_cast<std::size_t>(active));
    if (options.noCheck) return;
    const nlohmann::ordered_json errors = check(scene, volume, options, progress);
    if (options.json.empty()) return;
    const nlohmann::ordered_json root = {{"version", 1},
                                         {"scene", options.scene},
                                         {"probes", grid.size()},
                                         {"active", active},
                                         {"errors", errors}};
    const std::string text = root.dump(1) + "\n";
    io::writeFile(options.json, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

}  // namespace

void addBake(CLI::App& app) {
    auto options = std::make_shared<BakeOptions>();
    CLI::App* command = app.add_subcommand("bake", "light probes of a scene, for other programs");
    command->add_option("scene", options->scene, "a scene file, or builtin:NAME")->required();
    command->add_option("-o,--output", options->out, "the folder that gets probes.json and its pictures")
        ->required();
    command->add_option("--spacing", options->spacing,
                        "between probes at most, m; without: an eighth of the scene");
    command->add_option("--samples", options->samples, "rays of a probe, 16 to 1048576")
        ->capture_default_str();
    command->add_option("--bounces", options->bounces, "of indirect light, 1 to 1000, or all")
        ->capture_default_str();
    command->add_option("--seed", options->seed, "of all random numbers")->capture_default_str();
    command->add_flag("--overwrite,--force", options->force, "write over files that are there");
    command->add_flag("--no-check", options->noCheck, "no picture, no errors");
    command->add_option("--check-size", options->checkSize, "of the picture that is checked, WxH")
        ->capture_default_str();
    command->add_option("--check-spp", options->checkSamples, "its samples per pixel")->capture_default_str();
    command->add_option("--picture", options->picture, "that picture as a file, lit by octahedral maps");
    command->add_option("--json", options->json, "the errors as a file");
    command->add_option("--camera", options->view.camera, "the camera of the picture, by name");
    options->view.addEnvironmentTo(*command);
    addMemory(*command);
    addAllowOutside(*command, options->view.allowOutside);
    options->view.noGround = true;  // what is written is the file's own
    command->callback([options] { run(*options); });
}

}  // namespace conelight::program
