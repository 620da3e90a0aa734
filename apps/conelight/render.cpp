// SPDX-License-Identifier: MIT
// `conelight render SCENE -o OUT`: one picture in any mode, without a display.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "command.h"
#include "conelight/error.h"
#include "io/gltf_write.h"
#include "io/image_file.h"
#include "picture_file.h"
#include "picture_source.h"
#include "script_run.h"
#include "stats_json.h"
#include "traced_picture.h"
#include "truth_options.h"

namespace conelight::program {
namespace {

struct RenderOptions {
    std::string scene;
    std::string output;
    std::string mode;
    std::string component = "full";
    std::string bounces;
    std::string aovs;
    std::string statsFile;
    std::string shaderDirectory;
    ViewOptions view;
    TracerOptions tracer;
    RadiosityOptions radiosity;
    ScriptOptions script;
};

using Layers = std::vector<std::pair<std::string, Image>>;

void reportBadPixels(const Image& image) {
    std::size_t bad = 0;
    for (const glm::vec4& pixel : image.pixels)
        if (!std::isfinite(pixel.x) || !std::isfinite(pixel.y) || !std::isfinite(pixel.z)) ++bad;
    if (bad > 0) std::fprintf(stderr, "conelight: %zu pixels are not finite\n", bad);
}

// Options of one mode mean nothing in another: better an error than a picture that was not asked for.
void checkModeOptions(const RenderOptions& options) {
    const bool traces = options.mode == "reference" || options.radiosity.specular;
    const std::string tracer = options.tracer.given();
    const bool seedOfBake = tracer == "--seed" && options.mode == "radiosity";
    if (!tracer.empty() && !traces && !seedOfBake)
        usage(tracer + ": belongs to mode reference; --mode reference would be right");
    const std::string radiosity = options.radiosity.given();
    if (!radiosity.empty() && options.mode != "radiosity")
        usage(radiosity + ": belongs to mode radiosity; --mode radiosity would be right");
}

void checkFiles(const RenderOptions& options) {
    if (options.output.empty() && options.radiosity.bakeFile.empty() && !options.script.given())
        usage("--output is required; -o PICTURE.png, for example, would be right");
    if (!options.output.empty()) {
        const io::ImageFormat format = io::imageFormatOf(options.output);
        if (!options.aovs.empty() && format != io::ImageFormat::Exr)
            usage(options.output +
                  ": --aov: this format holds one picture; a name ending in .exr would be right");
        io::checkWritable(options.output);
    }
    if (!options.radiosity.bakeFile.empty()) {
        const std::string extension = std::filesystem::path(options.radiosity.bakeFile).extension().string();
        if (extension != ".glb" && extension != ".gltf")
            usage("--bake: " + options.radiosity.bakeFile +
                  ": a name ending in .glb or .gltf would be right");
        io::checkWritable(options.radiosity.bakeFile);
    }
    if (!options.statsFile.empty()) io::checkWritable(options.statsFile);
}

// Components asked for: the picture's, then those of the layers; layers of the path tracer alone set what it
// has to keep.
void addComponents(const RenderOptions& options, PictureRequest& request) {
    request.components = {componentOf(options.component)};
    for (const std::string& aov : splitList(options.aovs)) {
        if (!isTracedLayer(aov)) {
            request.components.push_back(componentOf(aov));
            continue;
        }
        if (options.mode != "reference")
            usage("--aov: layer " + aov + " belongs to mode reference; --mode reference would be right");
        request.reference.perBounce = std::max(request.reference.perBounce, bounceLayer(aov));
    }
}

Layers layersOf(const RenderOptions& options, const Picture& picture) {
    Layers layers;
    std::size_t next = 1;
    for (const std::string& aov : splitList(options.aovs)) {
        if (isTracedLayer(aov))
            layers.emplace_back(aov, *layerOf(*picture.traced, aov));
        else
            layers.emplace_back(aov, picture.images[next++]);
    }
    return layers;
}

nlohmann::ordered_json statsOf(const RenderOptions& options, const PictureRequest& request,
                               const Picture& picture) {
    nlohmann::ordered_json json;
    if (picture.traced)
        json = tracedJson(*picture.traced);
    else
        json = statsJson(picture.stats);
    if (picture.baked) json["radiosity"] = bakeJson(*picture.baked);
    json["scene"] = options.scene;
    json["mode"] = request.mode;
    if (isRendererMode(request.mode)) json["voxels"] = request.settings.voxels.size;
    json["size"] = {request.size.width, request.size.height};
    return json;
}

// After a signal: what the files hold is said on the error output, then the program ends.
[[noreturn]] void endStopped(const RenderOptions& options, const PictureRequest& request,
                             const Picture& picture) {
    std::string what = "a picture that is not finished";
    if (picture.traced)
        what = fmt::format("{} of {} samples per pixel, noise {:.2g} %", picture.traced->samplesPerPixel,
                           request.reference.samplesPerPixel, 100 * picture.traced->noise);
    else if (picture.baked)
        what = fmt::format("radiosity with {:.2g} % of the light still under way",
                           100 * picture.baked->residual);
    const std::string& file = options.output.empty() ? options.radiosity.bakeFile : options.output;
    std::fprintf(stderr, "conelight: interrupted; %s holds %s\n", file.c_str(), what.c_str());
    throw InterruptedError();
}

PictureRequest requestOf(const RenderOptions& options) {
    PictureRequest request;
    request.size = parseSize(options.view.size);
    request.profile = !options.statsFile.empty();
    request.reference = options.tracer.settings();
    request.radiosity = options.radiosity.values;
    request.radiosity.seed = options.tracer.seed;
    request.radiositySpecular = options.radiosity.specular;
    addComponents(options, request);
    return request;
}

// The picture's request as the commands of --exec and --script left the session.
void takeSession(const Session& session, PictureRequest& request) {
    const PictureRequest shown = requestFor(session, request);
    request.settings = shown.settings;
    request.mode = shown.mode;
    request.camera = shown.camera;
    request.components.front() = shown.components.front();
}

void run(const RenderOptions& options) {
    // Everything that can be wrong on the command line is found before the work starts.
    if (!options.mode.empty()) requireModeName(options.mode);
    checkModeOptions(options);
    PictureRequest request = requestOf(options);
    checkFiles(options);

    Progress progress;
    Scene scene = openScene(options.scene, options.view, progress);
    const bool onCpu = !options.mode.empty() && !isRendererMode(options.mode);
    request.settings = settingsFor(scene, onCpu ? "cones" : options.mode, options.view);
    request.mode = onCpu ? options.mode : getSetting(request.settings, "mode");
    request.camera = cameraFor(scene, options.view);
    if (onCpu) {
        constexpr int kMost = 1000;
        if (!options.bounces.empty())
            request.reference.bounces = request.radiosity.bounces = parseBounces(options.bounces, kMost);
    } else {
        request.settings.component = request.components.front();
        applyBounces(request.settings, options.bounces);
        request.components.front() = request.settings.component;
    }

    PictureSource source(options.view, options.shaderDirectory);
    request.settings.component = request.components.front();
    Session session(std::move(scene), options.scene, request.settings, request.mode, request.camera);
    if (options.script.given()) {
        runScript(options.script, session, &source, request, progress);
        takeSession(session, request);
        if (options.output.empty() && options.radiosity.bakeFile.empty()) return;
    }
    source.setScene(session.scene());
    const Picture picture = source.draw(request, &progress);
    reportBadPixels(picture.images.front());
    if (!options.output.empty()) {
        progress.show("writing " + options.output);
        writePicture(options.output, picture.images.front(), request.settings.image,
                     layersOf(options, picture));
    }
    if (!options.radiosity.bakeFile.empty()) {
        progress.show("writing " + options.radiosity.bakeFile);
        const WritingScope writing;
        io::writeGltf(options.radiosity.bakeFile, source.bakedScene(request.radiosity, &progress));
    }
    if (!options.statsFile.empty()) writeJson(options.statsFile, statsOf(options, request, picture));
    progress.finish();
    if (picture.stopped) endStopped(options, request, picture);
}

}  // namespace

void addRender(CLI::App& app) {
    auto options = std::make_shared<RenderOptions>();
    CLI::App* command = app.add_subcommand("render", "draw a scene to a picture file, without a display");
    command
        ->add_option("scene", options->scene,
                     "a scene file, or builtin:NAME (`conelight info builtin:` lists them)")
        ->required();
    command->add_option("-o,--output", options->output,
                        "picture: .png .jpg (tone-mapped), .exr .hdr (linear radiance)");
    command->add_option("--mode", options->mode, modeNames() + " (default traced)");
    command
        ->add_option("--component", options->component,
                     "full, direct, indirect, diffuse or specular; but for mode reference also occlusion, "
                     "albedo, normal, depth, voxels or emission")
        ->capture_default_str();
    command
        ->add_option(
            "--bounces", options->bounces,
            "indirect bounces, or all: 0 = direct light and emission seen; mode cones: 0 to 8, all "
            "is 8; traced: 0 to 15 or all; modes reference and radiosity: any number, all is the default")
        ->type_name("N");
    command
        ->add_option("--aov", options->aovs,
                     "components that become further layers of an .exr, comma-separated; mode reference: "
                     "also " +
                         tracedLayerNames())
        ->type_name("A,B");
    command
        ->add_option("--stats", options->statsFile,
                     "write passes, lookups per pixel and memory, or samples, noise and rays, as JSON")
        ->type_name("FILE");
    command
        ->add_option("--shader-dir", options->shaderDirectory,
                     "shaders from this folder instead of the built-in ones")
        ->type_name("DIR");
    options->tracer.addTo(*command);
    options->radiosity.addTo(*command);
    options->view.addTo(*command);
    options->script.addTo(*command);
    command->callback([options] { run(*options); });
}

}  // namespace conelight::program
