// SPDX-License-Identifier: MIT
// `conelight score convergence`: how many frames after a light goes on or off until the picture is right.
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

// A light, or a material that emits, with the scene's two states of it.
struct Switch {
    std::string name;
    std::vector<Light> lightsOn, lightsOff;  // empty: a material
    std::size_t material = 0;
    Material materialOn, materialOff;

    void turn(Session& session, bool on) const {
        const std::string label = name + (on ? " on" : " off");
        if (lightsOn.empty())
            session.setMaterials({{material, on ? materialOn : materialOff}}, label);
        else
            session.setLights(on ? lightsOn : lightsOff, label);
    }
};

// Of the light called `name`; of the first there is when it is empty.
Switch switchOf(const Scene& scene, const std::string& name) {
    std::string names;
    for (std::size_t i = 0; i < scene.lights.size(); ++i) {
        const Light& light = scene.lights[i];
        names += (names.empty() ? "" : ", ") + light.name;
        if (!light.enabled || (!name.empty() && light.name != name)) continue;
        Switch found{light.name, scene.lights, scene.lights, 0, {}, {}};
        found.lightsOff[i].enabled = false;
        return found;
    }
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        const Material& material = scene.materials[i];
        if (material.emission == glm::vec3(0)) continue;
        names += (names.empty() ? "" : ", ") + material.name;
        if (!name.empty() && material.name != name) continue;
        Switch found{material.name, {}, {}, i, material, material};
        found.materialOff.emission = glm::vec3(0);
        return found;
    }
    throw Error(ErrorKind::Usage, names.empty()
                                      ? "score convergence: the scene has no light to switch"
                                      : "--light: there is no '" + name + "'; " + names + " would be right");
}

// One variant in one scene.
struct Convergence {
    const ConvergenceOptions& options;
    const Switch& light;
    Session session;
    PictureRequest request;
    Progress& progress;

    // The state that does not depend on what was there before.
    Image settled(bool on) {
        light.turn(session, on);
        PictureSource fresh(options.view);
        fresh.follow(session);
        PictureRequest finished = request;
        finished.frames = options.frames;
        return fresh.draw(finished, &progress).images.front();
    }

    // Errors of the frames after the switch, as a live program draws them, in parts of `mean`.
    std::vector<double> errors(PictureSource& source, bool on, const Image& truth, double mean) {
        light.turn(session, !on);
        source.follow(session);
        PictureRequest before = request;
        before.frames = options.frames;
        source.draw(before, &progress);
        light.turn(session, on);
        source.follow(session);
        PictureRequest live = request;
        live.settings.traced.budgeted = true;
        std::vector<double> all;
        for (int frame = 0; frame < options.frames; ++frame)
            all.push_back(
                reference::relativeDifference(source.draw(live, &progress).images.front(), truth, mean));
        return all;
    }
};

void run(const ConvergenceOptions& options) {
    const std::vector<Variant> variants = options.checked("convergence", true);
    const double within = parseFraction("--within", options.within);
    ScoreReport report("convergence", "frames", options);
    Table table({"scene", "mode", "light", "goes", fmt::format("frames to {}", percent(within)),
                 "error after 1", "2", "4", "8", "16"});
    Progress progress;
    std::string device;
    for (const std::string& path : options.scenes) {
        const Scene scene = openScene(path, options.view, progress);
        const Switch light = switchOf(scene, options.light);
        for (const Variant& variant : variants) {
            PictureRequest request = requestOf(variant, scene, options.view);
            Convergence one{options, light,
                            Session(scene, path, request.settings, variant.mode, request.camera), request,
                            progress};
            const Image truths[] = {one.settled(false), one.settled(true)};
            const double mean = reference::meanRadiance(truths[1]);
            PictureSource source(options.view);
            for (const bool on : {true, false}) {
                const std::vector<double> errors = one.errors(source, on, truths[on ? 1 : 0], mean);
                device = source.device();
                const int frames = reference::settledAt(errors, within);
                std::vector<std::string> row = {path, variant.label(), light.name, on ? "on" : "off",
                                                frames > 0 ? std::to_string(frames) : "never"};
                for (const std::size_t n : {1u, 2u, 4u, 8u, 16u})
                    row.push_back(n <= errors.size() ? percent(errors[n - 1]) : "");
                table.add(row);
                report.add(
                    path + " " + variant.label() + (on ? " on" : " off"), frames > 0 ? frames : std::nan(""),
                    {{"scene", path},
                     {"variant", variant.label()},
                     {"light", light.name},
                     {"goes", on ? "on" : "off"},
                     {"within", within},
                     {"frames", frames > 0 ? nlohmann::ordered_json(frames) : nlohmann::ordered_json()},
                     {"errors", errors}});
            }
        }
    }
    progress.finish();
    table.print(4);
    report.finish(device);
}

}  // namespace

void addScoreConvergence(CLI::App& score) {
    auto options = std::make_shared<ConvergenceOptions>();
    CLI::App* command =
        score.add_subcommand("convergence", "frames after a light goes on or off until the picture is right");
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
