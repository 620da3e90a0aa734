// SPDX-License-Identifier: MIT
// `conelight render SCENE -o OUT`: one picture, without a display.
#include <fmt/core.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "command.h"
#include "conelight/error.h"
#include "io/image_file.h"
#include "picture_file.h"
#include "picture_source.h"
#include "stats_json.h"

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
};

std::vector<std::string> splitList(const std::string& text) {
    std::vector<std::string> parts;
    std::size_t from = 0;
    while (from <= text.size() && !text.empty()) {
        const std::size_t comma = std::min(text.find(',', from), text.size());
        parts.push_back(text.substr(from, comma - from));
        from = comma + 1;
    }
    return parts;
}

void reportBadPixels(const Image& image) {
    std::size_t bad = 0;
    for (const glm::vec4& pixel : image.pixels)
        if (!std::isfinite(pixel.x) || !std::isfinite(pixel.y) || !std::isfinite(pixel.z)) ++bad;
    if (bad > 0) std::fprintf(stderr, "conelight: %zu pixels are not finite\n", bad);
}

void run(const RenderOptions& options) {
    // Everything that can be wrong on the command line is found before the work starts.
    const Size size = parseSize(options.view.size);
    const io::ImageFormat format = io::imageFormatOf(options.output);
    if (!options.aovs.empty() && format != io::ImageFormat::Exr)
        throw Error(
            ErrorKind::Usage,
            options.output + ": --aov: this format holds one picture; a name ending in .exr would be right");
    io::checkWritable(options.output);
    if (!options.statsFile.empty()) io::checkWritable(options.statsFile);
    if (!options.mode.empty()) requireModeName(options.mode);
    PictureRequest request;
    request.size = size;
    request.profile = !options.statsFile.empty();
    request.components = {componentOf(options.component)};
    const std::vector<std::string> aovs = splitList(options.aovs);
    for (const std::string& aov : aovs) request.components.push_back(componentOf(aov));

    Progress progress;
    const Scene scene = openScene(options.scene, options.view, progress);
    request.settings = settingsFor(scene, options.mode, options.view);
    request.settings.component = request.components.front();
    applyBounces(request.settings, options.bounces);
    request.components.front() = request.settings.component;
    request.mode = getSetting(request.settings, "mode");
    request.camera = cameraFor(scene, options.view);

    PictureSource source(options.view, options.shaderDirectory);
    source.setScene(scene);
    const Picture picture = source.draw(request, &progress);
    reportBadPixels(picture.images.front());

    std::vector<std::pair<std::string, Image>> layers;
    for (std::size_t i = 0; i < aovs.size(); ++i) layers.emplace_back(aovs[i], picture.images[i + 1]);
    progress.show("writing " + options.output);
    writePicture(options.output, picture.images.front(), request.settings.image, layers);
    if (!options.statsFile.empty()) {
        nlohmann::ordered_json json = statsJson(picture.stats);
        json["scene"] = options.scene;
        json["mode"] = request.mode;
        json["voxels"] = request.settings.voxels.size;
        json["size"] = {size.width, size.height};
        writeJson(options.statsFile, json);
    }
}

}  // namespace

void applyBounces(Settings& settings, const std::string& bounces) {
    if (bounces.empty()) return;
    constexpr int kAll = 8;  // what is left after 8 more bounces is below 1 % even at albedo 0.55
    char* end = nullptr;
    const long count = bounces == "all" ? kAll : std::strtol(bounces.c_str(), &end, 10);
    if (bounces != "all" && (*end != '\0' || count < 0 || count > kAll))
        throw Error(
            ErrorKind::Usage,
            "--bounces: '" + bounces + "' is not usable; a whole number from 0 to 8, or all, would be right");
    settings.cones.bounces = static_cast<int>(count);
    if (count == 0 && settings.component == Component::Full) settings.component = Component::Direct;
}

void addRender(CLI::App& app) {
    auto options = std::make_shared<RenderOptions>();
    CLI::App* command = app.add_subcommand("render", "draw a scene to a picture file, without a display");
    command
        ->add_option("scene", options->scene,
                     "a scene file, or builtin:NAME (`conelight info builtin:` lists them)")
        ->required();
    command
        ->add_option("-o,--output", options->output,
                     "picture: .png .jpg (tone-mapped), .exr .hdr (linear radiance)")
        ->required();
    command->add_option("--mode", options->mode, modeNames() + " (default cones)");
    command
        ->add_option(
            "--component", options->component,
            "full, direct, indirect, diffuse, specular, occlusion, albedo, normal, depth, voxels or emission")
        ->capture_default_str();
    command
        ->add_option("--bounces", options->bounces,
                     "indirect bounces (mode cones): 0 to 8 or all (8); 0 = direct light and emission seen")
        ->type_name("N");
    command
        ->add_option("--aov", options->aovs,
                     "components that become further layers of an .exr, comma-separated")
        ->type_name("A,B");
    command->add_option("--stats", options->statsFile, "write passes, lookups per pixel and memory as JSON")
        ->type_name("FILE");
    command
        ->add_option("--shader-dir", options->shaderDirectory,
                     "shaders from this folder instead of the built-in ones")
        ->type_name("DIR");
    options->view.addTo(*command);
    command->callback([options] { run(*options); });
}

}  // namespace conelight::program
