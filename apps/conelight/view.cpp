// SPDX-License-Identifier: MIT
// `conelight view [SCENE]`: the window. Of a picture file, with nothing but the picture in it.
#include <chrono>
#include <filesystem>

#include "command.h"
#include "console/statements.h"
#include "io/image_file.h"
#include "picture_input.h"
#include "script_run.h"
#include "session/session.h"
#include "truth_options.h"
#include "viewer/viewer.h"

namespace conelight::program {
namespace {

// Initialised before main().
const std::chrono::steady_clock::time_point kStarted = std::chrono::steady_clock::now();

struct ViewCommand {
    std::string scene = "builtin:cornell";
    std::string mode;
    std::string shaderDirectory;
    std::string window;  // empty: as it was last
    std::vector<std::string> commands;
    bool noInput = false;
    bool noState = false;
    bool timing = false;
    double uiScale = 0;
    int filmSamples = 0;
    RadiosityOptions radiosity;
    ViewOptions view;
};

Session openSession(const ViewCommand& options, const io::LoadOptions& watched = {}) {
    Progress progress;
    progress.watch = watched.progress;
    io::SceneAnimation animation;
    Scene scene = openScene(options.scene, options.view, progress, &animation);
    const std::string mode = modeFor(options.mode, options.view);
    const Settings settings = settingsFor(scene, isSettingsMode(mode) ? mode : "cones", options.view);
    const Camera camera = cameraFor(scene, options.view);
    Session session(std::move(scene), options.scene, settings,
                    mode.empty() ? getSetting(settings, "mode") : mode, camera);
    session.setAnimation(std::move(animation));
    session.setOpenHow(
        {options.view.allowOutside, !options.view.noGround, {options.scene, options.view.up}, mode});
    return session;
}

// A session without a scene: there is the picture to look at.
Session emptySession() {
    Scene scene;
    completeScene(scene);
    scene.notes.clear();
    const Camera camera = scene.cameras.empty() ? Camera{} : scene.cameras.front();
    Session session(std::move(scene), "", Settings{}, "", camera);
    ViewFlags flags = session.flags();
    flags.drawObjects = false;
    session.setFlags(flags, "no scene");
    return session;
}

// Before those that were asked for. 8-bit pictures have been through a tone map.
std::vector<std::string> commandsFor(const std::string& picture) {
    std::vector<std::string> commands{"keep " + quoted(picture), "flip on"};
    const io::ImageFormat format = io::imageFormatOf(picture);
    if (format == io::ImageFormat::Png || format == io::ImageFormat::Jpg)
        commands.emplace_back("set image.tone_map none");
    return commands;
}

int run(const ViewCommand& options) {
    const Size size = options.window.empty() ? Size{0, 0} : parseSize(options.window);
    // A file that is not there needs no window to be said.
    std::error_code ignored;
    const bool picture = isPictureFile(options.scene);
    if (picture)
        readLayers(options.scene);
    else if (options.scene.rfind("builtin:", 0) != 0 && !std::filesystem::exists(options.scene, ignored))
        openSession(options);
    ViewerOptions viewer;
    viewer.width = size.width;
    viewer.height = size.height;
    viewer.renderer = rendererOptions(options.view, options.shaderDirectory);
    if (picture) viewer.commands = commandsFor(options.scene);
    viewer.commands.insert(viewer.commands.end(), options.commands.begin(), options.commands.end());
    viewer.readStdin = !options.noInput;
    viewer.keepState = !options.noState;
    viewer.timing = options.timing;
    viewer.uiScale = static_cast<float>(options.uiScale);
    viewer.filmSamples = options.filmSamples;
    viewer.radiosity = options.radiosity.values;
    viewer.startedMs = std::chrono::duration<double, std::milli>(kStarted.time_since_epoch()).count();
    viewer.scene = options.scene;
    viewer.open = [&options, picture](const io::LoadOptions& watched) {
        return picture ? emptySession() : openSession(options, watched);
    };
    return runViewer(viewer);
}

}  // namespace

void addView(CLI::App& app) {
    auto options = std::make_shared<ViewCommand>();
    CLI::App* command = app.add_subcommand("view", "a window on a scene: fly through it, turn every knob");
    command
        ->add_option("scene", options->scene, "a scene file, builtin:NAME, or a picture: .exr .hdr .png .jpg")
        ->capture_default_str();
    command->add_option("--mode", options->mode, "mode to start in");
    command
        ->add_option("--shader-dir", options->shaderDirectory,
                     "shaders from this folder instead of the built-in ones; changes show at once")
        ->type_name("DIR");
    command->add_option("--exec", options->commands, "console commands to run first; may be repeated")
        ->type_name("COMMANDS")
        ->allow_extra_args(false);
    command->add_flag("--no-input", options->noInput, "do not read commands from standard input");
    command->add_flag(
        "--no-state", options->noState,
        "remember nothing: neither the window's look nor scenes, typed lines and unsaved changes");
    command->add_flag("--timing", options->timing,
                      "print when the first frame was shown, and at the end what frames cost");
    command
        ->add_option("--ui-scale", options->uiScale,
                     "size of text and widgets, 1 on ordinary screens; the screen's by default")
        ->check(CLI::Range(0.5, 4.0));
    command
        ->add_option("--spp", options->filmSamples,
                     "films of mode reference: samples per pixel of each frame (default 256)")
        ->type_name("N")
        ->check(CLI::Range(1, 1 << 20));
    options->view.addTo(*command);
    command->remove_option(command->get_option("--size"));  // of pictures without a window
    command
        ->add_option("--window,--size", options->window,
                     "size of the window; by default as it was last, at first 1280x800")
        ->type_name("WxH");
    options->radiosity.addSolverTo(*command);
    command->callback([options] {
        if (const int status = run(*options); status != 0) throw QuitRequest{status};
    });
}

}  // namespace conelight::program
