// SPDX-License-Identifier: MIT
// `conelight info [FILE]`: the OpenGL device, or what a scene or a picture holds. `conelight info builtin:` lists the
// generated scenes.
#include <fmt/core.h>

#include "command.h"
#include "conelight/error.h"
#include "io/animation.h"
#include "io/files.h"
#include "io/generated.h"
#include "io/image_file.h"
#include "io/scene_file.h"
#include "io/scene_format.h"
#include "io/scene_info.h"
#include "platform/headless_context.h"

namespace conelight::program {
namespace {

struct InfoOptions {
    std::string scene;
    bool tree = false, objects = false;
    int device = -1;
    io::LoadOptions load;
};

void printDevice(int device) {
    for (const std::string& line : platform::listDevices()) fmt::print("EGL device {}\n", line);
    platform::HeadlessOptions options;
    options.device = device;
    const platform::HeadlessContext context(options);
    fmt::print("in use: {}\n", context.description());
    for (const platform::DeviceLimit& limit : platform::deviceLimits())
        fmt::print("  {:<36} {:>14}  (used: up to {})\n", limit.name, limit.value, limit.used);
    for (const auto& [extension, present] : platform::optionalExtensions())
        fmt::print("  {:<36} {:>14}\n", extension, present ? "used" : "absent");
}

// What the parser of a text format makes of the file, before it becomes a scene.
void printTree(const std::string& path) {
    const io::SceneFormat* format = io::sceneFormatOf(io::lowerExtension(path));
    if (format == nullptr || !format->syntax)
        usage("--tree: " + path +
              " is of no text format with blocks; a file of the thesis's format would be right");
    const io::Bytes bytes = io::readFile(path, 1 << 26);
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    for (const io::SyntaxLine& line : format->syntax(text, path))
        fmt::print("{:>5}  {:{}}{}\n", line.line, "", 2 * line.depth, line.text);
}

bool isPicture(const std::string& path) {
    const std::string extension = io::lowerExtension(path);
    return extension == ".png" || extension == ".exr";
}

// Size, layers, and how it was made.
void printPicture(const std::string& path) {
    std::vector<std::pair<std::string, std::string>> texts;
    if (io::imageFormatOf(path) == io::ImageFormat::Exr) {
        const io::FloatImage image = io::readExr(path);
        fmt::print("size       {} x {}, {} channels\n", image.width, image.height, image.channels);
        for (const io::ImageLayer& layer : image.layers)
            fmt::print("layer      {}, {} channels\n", io::oneLine(layer.name), layer.channels);
        texts = image.attributes;
    } else {
        const io::ByteImage image = io::readByteImage(path);
        fmt::print("size       {} x {}, {} channels\n", image.width, image.height, image.channels);
        texts = image.attributes;
    }
    for (const auto& [name, text] : texts)
        fmt::print("{:<10} {}\n", io::oneLine(name, 40), io::oneLine(text, 2000));
}

// What pictures of it will have beside.
void printAdded(Scene& scene) {
    const std::size_t notes = scene.notes.size();
    completeScene(scene);
    for (std::size_t i = notes; i < scene.notes.size(); ++i)
        fmt::print("{:<10} {}\n", "to be seen", scene.notes[i]);
}

void run(const InfoOptions& options) {
    if (options.objects && (options.scene.empty() || options.tree || isPicture(options.scene)))
        usage("--objects: needs a scene, and no --tree");
    if (!options.tree && isPicture(options.scene)) return printPicture(options.scene);
    if (options.tree) {
        if (options.scene.empty()) usage("--tree: needs a scene file");
        return printTree(options.scene);
    }
    if (options.scene.empty()) {
        printDevice(options.device);
    } else if (options.scene == "builtin:" || options.scene == "builtin") {
        for (const io::GeneratedSceneInfo& scene : io::generatedScenes()) {
            fmt::print("builtin:{:<16} {}\n", scene.name, scene.description);
            for (const auto& parameter : scene.parameters)
                fmt::print("    ?{}={:g}  {:g} to {:g}: {}\n", parameter.name, parameter.defaultValue,
                           parameter.min, parameter.max, parameter.meaning);
        }
    } else {
        io::SceneAnimation animation;
        Scene scene = io::loadAnimatedScene(options.scene, options.load, animation);
        fmt::print("{}", io::describeScene(scene));
        if (options.objects) fmt::print("{}", io::describeObjects(scene));
        printAdded(scene);
        if (animation.clips.empty()) return;
        fmt::print("clips      {}\n", animation.clips.size());
        for (const io::AnimationClip& clip : animation.clips)
            fmt::print("  {}: {:.4g} s, {} tracks\n", clip.name, clip.duration, clip.tracks.size());
    }
}

}  // namespace

void addInfo(CLI::App& app) {
    auto options = std::make_shared<InfoOptions>();
    CLI::App* command = app.add_subcommand("info", "the OpenGL device, or what a scene or a picture holds");
    command->add_option("scene", options->scene,
                        "a scene file, builtin:NAME, builtin: for a list, or a picture (.png .exr)");
    command->add_flag("--tree", options->tree,
                      "the syntax tree of a file of the thesis's format: line number, blocks and words");
    command->add_flag("--objects", options->objects,
                      "names of the instances, as --moving of bench and --path object=NAME of score flicker "
                      "take them");
    command->add_option("--device", options->device, "EGL device")
        ->type_name("N")
        ->check(CLI::NonNegativeNumber);
    addAllowOutside(*command, options->load.allowOutside);
    addUpAxis(*command, options->load.up);
    command->callback([options] { run(*options); });
}

}  // namespace conelight::program
