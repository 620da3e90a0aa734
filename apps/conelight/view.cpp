// SPDX-License-Identifier: MIT
// `conelight view [SCENE]`: the window.
#include <chrono>
#include <filesystem>

#include "command.h"
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
    std::string window = "1280x800";
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
    session.setOpenHow({options.view.allowOutside, !options.view.noGround});
    return session;
}

int run(const ViewCommand& options) {
    const Size size = parseSize(options.window);
    // A file that is not there needs no window to be said.
    std::error_code ignored;
    if (options.scene.rfind("builtin:", 0) != 0 && !std::filesystem::exists(options.scene, ignored))
        openSession(options);
    ViewerOptions viewer;
    viewer.width = size.width;
    viewer.height = size.height;
    viewer.renderer = rendererOptions(options.view, options.shaderDirectory);
    viewer.commands = options.commands;
    viewer.readStdin = !options.noInput;
    viewer.keepState = !options.noState;
    viewer.timing = options.timing;
    viewer.uiScale = static_cast<float>(options.uiScale);
    viewer.filmSamples = options.filmSamples;
    viewer.radiosity = options.radiosity.values;
    viewer.startedMs = std::chrono::duration<double, std::milli>(kStarted.time_since_epoch()).count();
    viewer.scene = options.scene;
    viewer.open = [&options](const io::LoadOptions& watched) { return openSession(options, watched); };
    return runViewer(viewer);
}

}  // namespace

void addView(CLI::App& app) {
    auto options = std::make_shared<ViewCommand>();
    CLI::App* command = app.add_subcommand("view", "a window on a scene: fly through it, turn every knob");
    command->add_option("scene", options->scene, "a scene file, or builtin:NAME")->capture_default_str();
    command->add_option("--mode", options->mode, "mode to start in");
    command
        ->add_option("--shader-dir", options->shaderDirectory,
                     "shaders from this folder instead of the built-in ones; changes show at once")
        ->type_name("DIR");
    command->add_option("--exec", options->commands, "console commands to run first; may be repeated")
        ->type_name("COMMANDS")
        ->allow_extra_args(false);
    command->add_flag("--no-input", options->noInput, "do not read commands from standard input");
    command->add_flag("--no-state", options->noState,
                      "remember nothing: neither scenes that were opened nor lines that were typed");
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
    command->add_option("--window,--size", options->window, "size of the window")
        ->capture_default_str()
        ->type_name("WxH");
    options->radiosity.addSolverTo(*command);
    command->callback([options] {
        if (const int status = run(*options); status != 0) throw QuitRequest{status};
    });
}

}  // namespace conelight::program
