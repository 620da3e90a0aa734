// SPDX-License-Identifier: MIT
// `conelight score convergence`: how many frames after a light is switched on until the picture is right.
#include <fmt/core.h>

#include <cmath>

#include "conelight/error.h"
#include "reference/scores.h"
#include "score.h"

namespace conelight::program {
namespace {

struct ConvergenceOptions : ScoreOptions {
    std::string light;
    std::string within = "5%";
    int frames = 16;
};

// The scene with the light called `name` off: a light, or a material that emits. No name: the first there is.
Scene switchedOff(const Scene& scene, std::string& name) {
    Scene off = scene;
    std::string names;
    for (Light& light : off.lights) {
        names += (names.empty() ? "" : ", ") + light.name;
        if (!light.enabled || (!name.empty() && light.name != name)) continue;
        light.enabled = false;
        name = light.name;
        return off;
    }
    for (Material& material : off.materials) {
        if (material.emission == glm::vec3(0)) continue;
        names += (names.empty() ? "" : ", ") + material.name;
        if (!name.empty() && material.name != name) continue;
        material.emission = glm::vec3(0);
        name = material.name;
        return off;
    }
    throw Error(ErrorKind::Usage, names.empty()
                                      ? "score convergence: the scene has no light to switch"
                                      : "--light: there is no '" + name + "'; " + names + " would be right");
}

// Settled: the state that does not depend on what was there before.
Image settledPicture(const ConvergenceOptions& options, const Scene& scene, PictureRequest request,
                     Progress& progress) {
    PictureSource fresh(options.view);
    fresh.setScene(scene);
    request.frames = options.frames;
    return fresh.draw(request, &progress).images.front();
}

void run(const ConvergenceOptions& options) {
    const std::vector<Variant> variants = options.checked("convergence", true);
    const double within = parseFraction("--within", options.within);
    ScoreReport report("convergence", "frames", options);
    Table table({"scene", "mode", "light", fmt::format("frames to {}", percent(within)), "error after 1", "2",
                 "4", "8", "16"});
    Progress progress;
    std::string device;
    for (const std::string& path : options.scenes) {
        const Scene on = openScene(path, options.view, progress);
        std::string light = options.light;
        const Scene off = switchedOff(on, light);
        for (const Variant& variant : variants) {
            PictureRequest request;
            request.mode = variant.mode;
            request.settings = variant.settingsFor(on, options.view);
            request.camera = cameraFor(on, options.view);
            request.size = parseSize(options.view.size);
            const Image settled = settledPicture(options, on, request, progress);
            PictureSource source(options.view);
            source.setScene(off);
            request.frames = options.frames;
            source.draw(request, &progress);
            source.setScene(on);
            request.frames = 1;
            std::vector<double> errors;
            for (int frame = 0; frame < options.frames; ++frame)
                errors.push_back(
                    reference::relativeDifference(source.draw(request, &progress).images.front(), settled));
            device = source.device();
            const int frames = reference::settledAt(errors, within);
            std::vector<std::string> row = {path, variant.label(), light,
                                            frames > 0 ? std::to_string(frames) : "never"};
            for (const std::size_t n : {1u, 2u, 4u, 8u, 16u})
                row.push_back(n <= errors.size() ? percent(errors[n - 1]) : "");
            table.add(row);
            report.add(path + " " + variant.label(), frames > 0 ? frames : std::nan(""),
                       {{"scene", path},
                        {"variant", variant.label()},
                        {"light", light},
                        {"within", within},
                        {"frames", frames > 0 ? nlohmann::ordered_json(frames) : nlohmann::ordered_json()},
                        {"errors", errors}});
        }
    }
    progress.finish();
    table.print(3);
    report.finish(device);
}

}  // namespace

void addScoreConvergence(CLI::App& score) {
    auto options = std::make_shared<ConvergenceOptions>();
    CLI::App* command =
        score.add_subcommand("convergence", "frames after a light is switched on until the picture is right");
    command->add_option("scenes", options->scenes, "scene files or builtin:NAME")->required();
    command->add_option("--light", options->light, "a light, or a material that emits (default: the first)")
        ->type_name("NAME");
    command->add_option("--within", options->within, "of the settled picture, as relRMSE; 5% or 0.05")
        ->capture_default_str()
        ->type_name("X");
    command->add_option("--frames", options->frames, "frames that are watched")
        ->capture_default_str()
        ->check(CLI::Range(1, 10000));
    options->addTo(*command, "cones", "256x256");
    command->callback([options] { run(*options); });
}

}  // namespace conelight::program
