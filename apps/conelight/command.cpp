// SPDX-License-Identifier: MIT
#include "command.h"

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <mutex>
#include <thread>

#include "conelight/error.h"
#include "conelight/quality.h"
#include "conelight/studio.h"
#include "io/animation.h"
#include "io/cone_set_file.h"
#include "io/environment_file.h"
#include "io/generated_surroundings.h"
#include "io/program_files.h"
#include "io/scene_file.h"
#include "memory_limit.h"
#include "session/lens_range.h"
#include "session/session.h"
#include "traced_picture.h"

namespace conelight::program {

struct Progress::Line {
    std::mutex mutex;
    std::condition_variable ended;
    std::string text;
    std::chrono::steady_clock::time_point since;
    std::chrono::steady_clock::time_point printed;
    bool shown = false, ends = false;
    std::thread clock;

    void print(const std::string& now) {
        std::fprintf(stderr, "\r\033[K%s", now.c_str());
        std::fflush(stderr);
    }
    void count() {
        constexpr auto kTick = std::chrono::seconds(1);
        std::unique_lock lock(mutex);
        while (!ended.wait_for(lock, kTick, [this] { return ends; })) {
            const auto gone = std::chrono::steady_clock::now() - since;
            if (shown && gone >= kTick)
                print(text + ", " + timeText(std::chrono::duration<double>(gone).count()));
        }
    }
};

Progress::Progress() : line_(isatty(STDERR_FILENO) != 0 ? std::make_unique<Line>() : nullptr) {
    if (line_) line_->clock = std::thread([this] { line_->count(); });
}

Progress::~Progress() {
    finish();
    if (!line_) return;
    {
        const std::lock_guard lock(line_->mutex);
        line_->ends = true;
    }
    line_->ended.notify_one();
    line_->clock.join();
}

void Progress::show(const std::string& text) {
    if (!line_) return;
    const std::lock_guard lock(line_->mutex);
    line_->text = text;
    line_->since = std::chrono::steady_clock::now();
    line_->shown = true;
    line_->print(text);
}

bool Progress::showLoading(const std::string& path, const io::LoadStep& step) {
    if (line_ && step.total > 0) {
        constexpr auto kTick = std::chrono::milliseconds(100);
        const std::lock_guard lock(line_->mutex);
        const auto now = std::chrono::steady_clock::now();
        line_->text = fmt::format("loading {}: {}, {} of {}", path, step.name, step.done, step.total);
        if (line_->shown && now - line_->printed > kTick) {
            line_->printed = now;
            line_->print(line_->text);
        }
    }
    return !watch || watch(step);
}

void Progress::finish() {
    if (!line_) return;
    const std::lock_guard lock(line_->mutex);
    if (line_->shown) std::fprintf(stderr, "\r\033[K");
    line_->shown = false;
}

Size parseSize(const std::string& text) {
    const std::size_t cross = text.find('x');
    Size size;
    char* end = nullptr;
    if (cross != std::string::npos) {
        size.width = static_cast<int>(std::strtol(text.c_str(), &end, 10));
        const bool widthRead = end == text.c_str() + cross;
        size.height = static_cast<int>(std::strtol(text.c_str() + cross + 1, &end, 10));
        if (widthRead && *end == '\0' && size.width >= 1 && size.height >= 1 && size.width <= 16384 &&
            size.height <= 16384)
            return size;
    }
    usage(fmt::format("--size: '{}' is not a picture size; WIDTHxHEIGHT with 1 to 16384 each would be right",
                      text));
}

double parseNumber(const std::string& option, const std::string& text) {
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    if (text.empty() || *end != '\0' || !std::isfinite(value))
        usage(fmt::format("{}: '{}' is not a number", option, text));
    return value;
}

glm::vec3 parseVec3(const std::string& option, const std::string& text) {
    const std::size_t first = text.find(',');
    const std::size_t second = first == std::string::npos ? first : text.find(',', first + 1);
    if (second == std::string::npos || text.find(',', second + 1) != std::string::npos)
        usage(fmt::format("{}: '{}' is not three numbers; x,y,z would be right", option, text));
    return {static_cast<float>(parseNumber(option, text.substr(0, first))),
            static_cast<float>(parseNumber(option, text.substr(first + 1, second - first - 1))),
            static_cast<float>(parseNumber(option, text.substr(second + 1)))};
}

std::vector<std::string> splitList(const std::string& text) {
    std::vector<std::string> parts;
    for (std::size_t from = 0; from <= text.size() && !text.empty();) {
        const std::size_t comma = std::min(text.find(',', from), text.size());
        parts.push_back(text.substr(from, comma - from));
        from = comma + 1;
    }
    return parts;
}

void ViewOptions::addCameraTo(CLI::App& command) {
    command.add_option("--camera", camera, "a camera of the scene: its name, or its number from 0")
        ->type_name("NAME");
    command.add_option("--eye", eye, "camera position instead of a camera of the scene")->type_name("X,Y,Z");
    command.add_option("--target", target, "what the camera looks at")->type_name("X,Y,Z");
    command.add_option("--fov", fovDeg, "vertical field of view in degrees")
        ->type_name("DEG")
        ->check(CLI::Range(1.0, 170.0));
    command
        .add_option("--lens", lensDiameter,
                    "diameter of the camera's lens in m: what is out of focus is blurred, in stills and mode "
                    "reference; 0: a pinhole")
        ->type_name("M")
        ->check(CLI::Range(0.0, static_cast<double>(kWidestLens)));
    command
        .add_option("--focus", focusDistance,
                    "distance of the plane in focus in m, along the view; 0: through the target")
        ->type_name("M")
        ->check(CLI::Range(0.0, 1e6));
    command
        .add_option("--orthographic", orthographicHeight,
                    "parallel rays that show so many m from top to bottom; 0: perspective")
        ->type_name("M")
        ->check(CLI::Range(0.0, static_cast<double>(kTallestView)));
}

void ViewOptions::addTo(CLI::App& command) {
    command.add_option("--size", size, "picture size")->capture_default_str()->type_name("WxH");
    command.add_option("--voxels", voxels, "voxels along the longest axis (same as --set voxels.size=N)")
        ->type_name("N");
    command
        .add_option(
            "--preset", preset,
            "settings from a file, as the console's `preset save` writes it; what it does not name is as "
            "the scene starts; options and --set come after it")
        ->type_name("FILE");
    std::string qualities;
    for (const QualityInfo& info : qualityInfos()) qualities += "\n" + info.name + ": " + qualityText(info);
    command
        .add_option(
            "--quality", quality,
            "work of mode traced (same as --set traced.quality=NAME before all others); errors are in "
            "docs/measurements/modes_vs_reference.md; costs:" +
                qualities)
        ->type_name("NAME");
    command
        .add_option(
            "--cone-set", coneSet,
            "directions, apertures and weights of the diffuse cones of modes cones and hybrid, from a file "
            "(cones.diffuse_set=own)")
        ->type_name("FILE");
    addCameraTo(command);
    command.add_option("--sky", sky, "constant sky radiance instead of the scene's, W/(sr m^2)")
        ->type_name("R,G,B");
    addEnvironmentTo(command);
    command.add_option("--set", sets, "a setting (`conelight settings` lists them); may be repeated")
        ->type_name("KEY=VALUE")
        ->allow_extra_args(false);
    addContextTo(command);
    command.add_flag("--no-ground", noGround,
                     "no ground below a scene that has neither light nor a floor of its own");
    addMemory(command);
    addAllowOutside(command, allowOutside);
    addUpAxis(command, up);
}

void ViewOptions::addContextTo(CLI::App& command) {
    command.add_option("--device", device, "EGL device (`conelight info` lists them)")
        ->type_name("N")
        ->check(CLI::NonNegativeNumber);
    command.add_flag("--gl-debug", debugGl,
                     "check every OpenGL call and report errors of the driver (slower)");
    command
        .add_option(
            "--execution", execution,
            "shape of passes that write each pixel once: fragments for a processor, compute for a GPU; auto: "
            "by the driver")
        ->type_name("auto|processor|gpu")
        ->check(CLI::IsMember({"auto", "processor", "gpu"}));
    command
        .add_option(
            "--program-cache", programCache,
            "linked programs are kept in $XDG_CACHE_HOME/conelight/programs (~/.cache by default) and "
            "loaded from there; auto: with a GPU")
        ->type_name("auto|on|off")
        ->check(CLI::IsMember({"auto", "on", "off"}));
}

void ViewOptions::addEnvironmentTo(CLI::App& command) {
    std::string known;
    for (const io::GeneratedSceneInfo& info : io::generatedSurroundings())
        known += fmt::format("{}builtin:{}", known.empty() ? "" : ", ", info.name);
    CLI::Option* file =
        command
            .add_option("--environment", environment,
                        "surroundings instead of the scene's: a latitude-longitude picture (.exr .hdr), " +
                            known + ", or none")
            ->type_name("FILE");
    command
        .add_option("--rotate", rotateDeg, "turn of the environment, degrees, counter-clockwise from above")
        ->type_name("DEG")
        ->check(CLI::Range(-360.0, 360.0));
    command.add_option("--environment-strength", environmentStrength, "factor of the environment's radiance")
        ->type_name("X")
        ->check(CLI::Range(0.0, 1e9));
    command
        .add_flag("--split-sun", splitsSun,
                  "take the sun out of the environment's picture, as a light with sharp shadows")
        ->needs(file);
}

void addAllowOutside(CLI::App& command, bool& allow) {
    command.add_flag("--allow-outside", allow,
                     "a scene may name files outside its own folder; only for scenes that you trust");
}

void addUpAxis(CLI::App& command, io::UpAxis& up) {
    command
        .add_option_function<std::string>(
            "--up", [&up](const std::string& word) { up = *upAxisOf(word); },
            "the axis of a model's file that points up (.obj .ply .stl and others, not glTF); auto: what the "
            "format "
            "or comments say, else what the shape shows")
        ->type_name("x|y|z|auto")
        ->check(CLI::IsMember({"x", "y", "z", "auto"}));
}

RendererOptions rendererOptions(const ViewOptions& options, const std::string& shaderDirectory) {
    RendererOptions made{shaderDirectory, options.debugGl, Execution::Auto};
    if (options.execution == "processor") made.execution = Execution::Processor;
    if (options.execution == "gpu") made.execution = Execution::Gpu;
    const std::filesystem::path folder = io::programFolder();
    if (options.programCache != "off" && !folder.empty())
        made.programs = std::make_shared<io::ProgramFiles>(folder, options.programCache == "on");
    return made;
}

std::unique_ptr<platform::HeadlessContext> openContext(const ViewOptions& options) {
    platform::HeadlessOptions contextOptions;
    contextOptions.device = options.device;
    contextOptions.debug = options.debugGl;
    return std::make_unique<platform::HeadlessContext>(contextOptions);
}

namespace {

// What --environment and the options beside it ask for; without it they change what the scene has.
void applyEnvironment(Scene& scene, const ViewOptions& options) {
    const auto rotation = glm::radians(static_cast<float>(options.rotateDeg));
    const auto strength = static_cast<float>(options.environmentStrength);
    if (options.environment == "none") {
        scene.environment = {};
    } else if (!options.environment.empty()) {
        io::useEnvironment(scene, io::loadEnvironment(options.environment), rotation, strength);
    } else {
        scene.environment.rotation += rotation;
        scene.environment.strength *= strength;
    }
    if (options.splitsSun && !splitSun(scene))
        scene.notes.push_back(options.environment + ": no sun in the picture; none was split off");
}

}  // namespace

Scene openScene(const std::string& path, const ViewOptions& options, Progress& progress,
                io::SceneAnimation* animation, bool needsClips) {
    progress.show("loading " + path);
    io::LoadOptions load;
    load.allowOutside = options.allowOutside;
    load.maxTexels = texelsWithin(load.maxTexels);
    load.up = options.up;
    load.progress = [&](const io::LoadStep& step) { return progress.showLoading(path, step); };
    const HostMemoryLimit limit;
    Scene scene = animation == nullptr ? io::loadScene(path, load)
                  : needsClips         ? io::loadAnimatedScene(path, load, *animation)
                                       : io::loadMovingScene(path, load, *animation);
    if (!options.sky.empty()) scene.sky = glm::max(parseVec3("--sky", options.sky), glm::vec3(0));
    applyEnvironment(scene, options);
    completeScene(scene, {.ground = !options.noGround});
    progress.finish();
    for (const std::string& note : scene.notes)
        std::fprintf(stderr, "conelight: %s: %s\n", path.c_str(), note.c_str());
    return scene;
}

Settings settingsFor(const Scene& scene, const std::string& mode, const ViewOptions& options) {
    const auto start = [&](const std::string& startMode) {
        Settings settings = startSettings(scene, startMode);
        const bool set = std::any_of(scene.settings.begin(), scene.settings.end(),
                                     [](const auto& one) { return one.first == "image.antialiasing"; });
        if (!set) settings.image.antialiasing = options.stillViews.value_or(0);
        return settings;
    };
    Settings settings = start(mode);
    if (!options.preset.empty()) {
        const Preset preset = readPreset(options.preset);
        if (mode.empty() && isSettingsMode(preset.mode) && !preset.mode.empty())
            settings = start(preset.mode);
        preset.apply(settings);
    }
    if (!options.quality.empty()) setSetting(settings, "traced.quality", options.quality);
    if (!options.coneSet.empty()) {
        settings.cones.ownSet = io::readConeSet(options.coneSet);
        settings.cones.diffuseSet = DiffuseSet::Own;
    }
    if (options.voxels != 0) setSetting(settings, "voxels.size", std::to_string(options.voxels));
    for (const std::string& set : options.sets) {
        const std::size_t equals = set.find('=');
        if (equals == std::string::npos)
            usage(fmt::format("--set: '{}' has no '='; KEY=VALUE would be right", set));
        setSetting(settings, set.substr(0, equals), set.substr(equals + 1));
    }
    return settings;
}

std::string modeFor(const std::string& given, const ViewOptions& options) {
    return given.empty() && !options.preset.empty() ? readPreset(options.preset).mode : given;
}

Camera cameraFor(const Scene& scene, const ViewOptions& options) {
    Camera camera = scene.cameras.front();
    if (!options.camera.empty()) {
        const Camera* found = nullptr;
        for (const Camera& one : scene.cameras)
            if (one.name == options.camera && found == nullptr) found = &one;
        char* end = nullptr;
        const long index = std::strtol(options.camera.c_str(), &end, 10);
        if (found == nullptr && *end == '\0' && index >= 0 && index < static_cast<long>(scene.cameras.size()))
            found = &scene.cameras[static_cast<std::size_t>(index)];
        if (found == nullptr) {
            std::string names;
            for (const Camera& one : scene.cameras) names += (names.empty() ? "" : ", ") + one.name;
            usage(fmt::format("--camera: there is no camera '{}'; {} would be right", options.camera, names));
        }
        camera = *found;
    }
    if (!options.eye.empty()) camera.eye = parseVec3("--eye", options.eye);
    if (!options.target.empty()) camera.target = parseVec3("--target", options.target);
    if (options.fovDeg > 0) camera.fovY = static_cast<float>(options.fovDeg * 3.14159265358979 / 180.0);
    if (options.lensDiameter) camera.lensDiameter = static_cast<float>(*options.lensDiameter);
    if (options.focusDistance) camera.focusDistance = static_cast<float>(*options.focusDistance);
    if (options.orthographicHeight)
        camera.orthographicHeight = static_cast<float>(*options.orthographicHeight);
    if (glm::length(camera.target - camera.eye) < 1e-9f) usage("--eye and --target: both are the same point");
    return camera;
}

}  // namespace conelight::program
