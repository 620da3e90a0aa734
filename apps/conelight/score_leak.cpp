// SPDX-License-Identifier: MIT
// `conelight score leak`: light in a place that the reference says is black, swept over voxel sizes and the
// angle of the wall that should keep it out.
#include <fmt/core.h>

#include "conelight/error.h"
#include "reference/scores.h"
#include "reference_file.h"
#include "score.h"

namespace conelight::program {
namespace {

struct LeakOptions : ScoreOptions {
    std::string angles = "0,15,30";
    std::string dark = "dark", lit = "lit";
    std::string cache;
    TracerOptions tracer;
};

// What the path tracer needs to tell black from dim: paths that find no light in 32 tries per pixel, over a
// whole picture, carry none that would count.
constexpr int kSamples = 32;

bool turns(const std::string& scene) { return scene.rfind("builtin:leak", 0) == 0; }

std::string turned(const std::string& scene, const std::string& angle) {
    return scene + (scene.find('?') == std::string::npos ? "?" : "&") + "angle=" + angle;
}

Camera cameraNamed(const Scene& scene, const ViewOptions& view, const std::string& name) {
    ViewOptions chosen = view;
    chosen.camera = name;
    return cameraFor(scene, chosen);
}

struct Leaks {
    const LeakOptions& options;
    PictureSource& source;
    Progress& progress;
    ScoreReport& report;
    Table& table;

    void scene(const std::string& path, const std::string& angle, const std::vector<Variant>& variants) {
        const Scene scene = openScene(path, options.view, progress);
        source.setScene(scene);
        PictureRequest darkRequest, litRequest;
        darkRequest.size = litRequest.size = parseSize(options.view.size);
        darkRequest.reference = litRequest.reference = options.tracer.settings();
        if (options.tracer.given().empty())
            darkRequest.reference.samplesPerPixel = litRequest.reference.samplesPerPixel = kSamples;
        darkRequest.camera = cameraNamed(scene, options.view, options.dark);
        litRequest.camera = cameraNamed(scene, options.view, options.lit);
        const ReferencePicture dark =
            referenceFor(source, scene, darkRequest, options.cache, "leak-dark", &progress);
        const ReferencePicture lit =
            referenceFor(source, scene, litRequest, options.cache, "leak-lit", &progress);
        for (const Variant& variant : variants) {
            for (PictureRequest* request : {&darkRequest, &litRequest}) {
                request->mode = variant.mode;
                request->settings = variant.settingsFor(scene, options.view);
            }
            const Image darkImage = source.draw(darkRequest, &progress).images.front();
            const Image litImage = source.draw(litRequest, &progress).images.front();
            const reference::LeakScore score = reference::leakScore(darkImage, dark.full, litImage, lit.full);
            table.add(
                {path, variant.label(), number(score.darkMean), number(score.litMean), percent(score.ratio)});
            nlohmann::ordered_json json = {{"scene", path}, {"variant", variant.label()}};
            if (!angle.empty()) json["angle"] = std::stod(angle);
            json.update({{"leak", score.ratio},
                         {"dark_mean", score.darkMean},
                         {"lit_mean", score.litMean},
                         {"dark_pixels", score.darkPixels}});
            report.add(path + " " + variant.label(), score.ratio, json);
        }
    }
};

void run(LeakOptions& options) {
    if (options.scenes.empty()) options.scenes = {"builtin:leak"};
    if (options.variants.varies.empty() && options.view.voxels == 0)
        options.variants.varies = {"voxels.size=64,128"};
    const std::vector<Variant> variants = options.checked("leak", false);
    for (const std::string& angle : splitList(options.angles)) parseNumber("--angles", angle);
    PictureSource source(options.view);
    ScoreReport report("leak", "radiance of the dark side / of the lit side", options);
    Table table({"scene", "mode", "dark mean", "lit mean", "leak"});
    Progress progress;
    Leaks leaks{options, source, progress, report, table};
    for (const std::string& path : options.scenes) {
        if (!turns(path) || path.find("angle=") != std::string::npos) {
            leaks.scene(path, "", variants);
            continue;
        }
        for (const std::string& angle : splitList(options.angles))
            leaks.scene(turned(path, angle), angle, variants);
    }
    progress.finish();
    table.print(2);
    report.finish(source.device());
}

}  // namespace

void addScoreLeak(CLI::App& score) {
    auto options = std::make_shared<LeakOptions>();
    CLI::App* command = score.add_subcommand("leak", "light in a place that the reference says is black");
    command->add_option("scenes", options->scenes,
                        "scene files or builtin:NAME with a camera on either side (default builtin:leak)");
    command->add_option("--angles", options->angles, "builtin:leak: of the wall, degrees, comma-separated")
        ->capture_default_str()
        ->type_name("A,B");
    command->add_option("--dark", options->dark, "camera in the dark")
        ->capture_default_str()
        ->type_name("NAME");
    command->add_option("--lit", options->lit, "camera in the light")
        ->capture_default_str()
        ->type_name("NAME");
    command->add_option("--cache", options->cache, "folder in which reference pictures are kept")
        ->type_name("DIR");
    options->tracer.addTo(
        *command,
        "mode reference: center (a point per pixel, as the other modes; the default) or box "
        "(its area)");
    options->addTo(*command, "thesis,cones", "128x128");
    command->callback([options] { run(*options); });
}

}  // namespace conelight::program
