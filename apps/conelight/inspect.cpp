// SPDX-License-Identifier: MIT
// `conelight inspect SCENE --pixel X,Y`: how the light of one pixel was gathered.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "command.h"
#include "conelight/error.h"
#include "inspection_text.h"
#include "io/image_file.h"
#include "outputs.h"
#include "picture_file.h"
#include "picture_source.h"
#include "script_run.h"
#include "session/inspection_lines.h"
#include "session/picker.h"
#include "stats_json.h"

namespace conelight::program {
namespace {

struct InspectOptions {
    std::string scene;
    std::string pixel;
    std::string mode;
    std::string component = "full";
    std::string jsonFile;
    std::string output;
    bool steps = false;
    ViewOptions view;
    ScriptOptions script;
};

glm::ivec2 parsePixel(const std::string& text, const Size& size) {
    int x = 0, y = 0, end = 0;
    const bool read = std::sscanf(text.c_str(), "%d,%d%n", &x, &y, &end) == 2 &&
                      static_cast<std::size_t>(end) == text.size();
    if (!read || x < 0 || y < 0 || x >= size.width || y >= size.height)
        usage(
            fmt::format("--pixel: '{}' is no pixel of a picture of {} x {}; X,Y from 0,0 (upper left) to "
                        "{},{} would be right",
                        text, size.width, size.height, size.width - 1, size.height - 1));
    return {x, y};
}

void run(const InspectOptions& options) {
    if (!options.mode.empty() && !isRendererMode(options.mode)) {
        requireModeName(options.mode);
        usage("--mode: " + options.mode +
              " keeps no cones or rays; traced, cones, thesis or phong would be right");
    }
    PictureRequest request;
    request.size = parseSize(options.view.size);
    const glm::ivec2 pixel = parsePixel(options.pixel, request.size);
    if (!options.output.empty()) io::imageFormatOf(options.output);
    std::vector<std::string> inputs = options.script.files;
    inputs.insert(inputs.end(), {options.scene, options.view.preset, options.view.environment});
    checkOutputs({{"--output", options.output}, {"--json", options.jsonFile, OutputKind::Json}}, inputs);

    Progress progress;
    Scene scene = openScene(options.scene, options.view, progress);
    request.settings = settingsFor(scene, options.mode, options.view);
    setSetting(request.settings, "component", options.component);
    request.mode = getSetting(request.settings, "mode");
    request.camera = cameraFor(scene, options.view);
    PictureSource source(options.view);
    Session session(std::move(scene), options.scene, request.settings, request.mode, request.camera);
    runScript(options.script, session, &source, request, progress);
    request = requestFor(session, request);
    source.setScene(session.scene());
    Picture picture = source.draw(request, &progress);
    const PixelInspection found = source.inspect(request, pixel.x, pixel.y);
    progress.finish();

    for (const std::string& line : inspectionText(found, options.steps)) fmt::print("{}\n", line);
    if (!options.jsonFile.empty()) writeJson(options.jsonFile, inspectionJson(found));
    if (options.output.empty()) return;
    Image& image = picture.images.front();
    Picker picker;
    const float aspect = static_cast<float>(request.size.width) / static_cast<float>(request.size.height);
    const float exposure = request.settings.image.exposure.resolve(autoExposure(image));
    for (const PictureLine& line :
         inspectionLines(found, session.camera(), aspect, -1, seenFrom(picker, session)))
        drawLine(image, line, std::exp2(-exposure));
    writePicture(options.output, image, request.settings.image);
}

}  // namespace

void addInspect(CLI::App& app) {
    auto options = std::make_shared<InspectOptions>();
    CLI::App* command =
        app.add_subcommand("inspect", "how the light of one pixel was gathered: its cones or rays");
    command->add_option("scene", options->scene, "a scene file, or builtin:NAME")->required();
    command->add_option("--pixel", options->pixel, "the pixel, from the upper left corner")
        ->type_name("X,Y")
        ->required();
    command->add_option("--mode", options->mode, "traced, cones or thesis (default traced)");
    command->add_option("--component", options->component, "of the picture; occlusion has rays of its own")
        ->capture_default_str();
    command->add_flag("--steps", options->steps, "print every step");
    command->add_option("--json", options->jsonFile, "write all steps as JSON")->type_name("FILE");
    command->add_option("-o,--output", options->output, "the picture with cones and rays drawn over it")
        ->type_name("FILE");
    options->view.addTo(*command);
    options->script.addTo(*command);
    command->callback([options] { run(*options); });
}

}  // namespace conelight::program
