// SPDX-License-Identifier: MIT
// `conelight thumbnail SCENE FILE`: a small picture of a scene, as file managers and the viewer's dialogs ask for it:
// PNG whatever the file's name, quick rather than good.
#include <filesystem>

#include "command.h"
#include "io/files.h"
#include "io/image_file.h"
#include "picture_source.h"
#include "session/thumbnail_files.h"

namespace conelight::program {
namespace {

struct ThumbnailCommand {
    std::string scene, output;
    int edge = 256;
    bool allowOutside = false;
};

void run(const ThumbnailCommand& options) {
    constexpr int kVoxels = 64;
    ViewOptions view;
    view.quality = "draft";
    view.voxels = kVoxels;
    view.allowOutside = options.allowOutside;
    io::checkWritable(options.output);
    Progress progress;
    const Scene scene = openScene(options.scene, view, progress);
    PictureRequest request;
    request.settings = settingsFor(scene, "", view);
    request.mode = getSetting(request.settings, "mode");
    request.camera = cameraFor(scene, view);
    request.size = {options.edge, options.edge * 3 / 4};
    PictureSource source(view);
    source.setScene(scene);
    const Picture picture = source.draw(request, &progress);
    progress.finish();
    const Image& image = picture.images.front();
    const WritingScope writing;
    io::writePng(options.output, {image.width, image.height, 3, toneMapped(image, request.settings.image),
                                  thumbnailTexts(options.scene)});
}

}  // namespace

void addThumbnail(CLI::App& app) {
    auto options = std::make_shared<ThumbnailCommand>();
    CLI::App* command =
        app.add_subcommand("thumbnail", "a small picture of a scene, quickly, for file managers");
    command->add_option("scene", options->scene, "a scene file, or builtin:NAME")->required();
    command->add_option("output", options->output, "the file, PNG whatever its name")->required();
    command->add_option("--edge", options->edge, "pixels of the longer edge")
        ->capture_default_str()
        ->check(CLI::Range(16, 2048));
    addAllowOutside(*command, options->allowOutside);
    command->callback([options] { run(*options); });
}

}  // namespace conelight::program
