// SPDX-License-Identifier: MIT
// `conelight render SCENE -o OUT`: one picture in any mode, without a display.
#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>

#include "clip_film.h"
#include "command.h"
#include "conelight/error.h"
#include "console/command_table.h"
#include "hour_of_day.h"
#include "io/gltf_write.h"
#include "io/image_file.h"
#include "outputs.h"
#include "picture_source.h"
#include "provenance.h"
#include "reference/picture_layers.h"
#include "script_run.h"
#include "session/why_black.h"
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
    std::string pathFile;
    std::string clip;
    float framesPerSecond = 30;
    std::string frameText;
    int frames = 0;  // 0: not given
    int firstFrame = 0;
    int allFrames = 0;  // 0: not given
    bool framesAreRange = false;
    bool turntable = false;
    bool overwrite = false;
    bool componentGiven = false;
    ViewOptions view;
    TracerOptions tracer;
    RadiosityOptions radiosity;
    int lampPoints = 0;  // 0: not given
    ScriptOptions script;
};

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
    const bool bakes = options.mode == "radiosity" || options.mode == "hybrid";
    const bool seedOfBake = tracer == "--seed" && bakes;
    const bool filterOfBeams = tracer == "--filter" && options.mode == "beams";
    if (!tracer.empty() && !traces && !seedOfBake && !filterOfBeams)
        usage(tracer + ": belongs to mode reference; --mode reference would be right");
    if (options.lampPoints > 0 && options.mode != "beams")
        usage("--lamp-points: belongs to mode beams; --mode beams would be right");
    const std::string solver = options.radiosity.givenSolver();
    if (!solver.empty() && !bakes)
        usage(solver + ": belongs to modes radiosity and hybrid; --mode radiosity would be right");
    const std::string radiosity = options.radiosity.given();
    if (!radiosity.empty() && options.mode != "radiosity")
        usage(radiosity + ": belongs to mode radiosity; --mode radiosity would be right");
}

bool isFilm(const RenderOptions& options) {
    return !options.pathFile.empty() || options.turntable || !options.clip.empty();
}

// --frames N, FIRST-LAST, or FIRST-LAST/N.
void parseFrames(RenderOptions& options) {
    if (options.frameText.empty()) return;
    constexpr int kMost = 100000;
    const std::string& text = options.frameText;
    const char* const end = text.data() + text.size();
    int first = 0, last = -1, total = 0;
    std::from_chars_result read = std::from_chars(text.data(), end, first);
    const bool isRange = read.ec == std::errc() && read.ptr != end && *read.ptr == '-';
    if (isRange) read = std::from_chars(read.ptr + 1, end, last);
    const bool hasTotal = isRange && read.ec == std::errc() && read.ptr != end && *read.ptr == '/';
    if (hasTotal) read = std::from_chars(read.ptr + 1, end, total);
    bool fits = isRange ? first >= 0 && last >= first && last < kMost : first >= 1 && first <= kMost;
    if (hasTotal) fits = fits && total > last && total <= kMost;
    if (read.ec != std::errc() || read.ptr != end || !fits)
        usage(
            fmt::format("--frames: '{}' is not usable; a number from 1 to {}, FIRST-LAST from 0, or "
                        "FIRST-LAST/ALL, would be right",
                        text, kMost));
    if (hasTotal && !options.clip.empty())
        usage("--frames: a clip has as many frames as --fps makes; FIRST-LAST would be right");
    options.firstFrame = isRange ? first : 0;
    options.frames = isRange ? last - first + 1 : first;
    options.allFrames = total;
    options.framesAreRange = isRange;
}

void checkFilm(const RenderOptions& options) {
    if (!options.pathFile.empty() && options.turntable)
        usage("--path, --turntable: both move the camera; one would be right");
    const bool films = isVideoName(options.output);
    if (!isFilm(options)) {
        if (!options.frameText.empty())
            usage("--frames: belongs to --path FILE, --turntable or --animate CLIP");
        if (films) usage(options.output + ": a film needs --path FILE, --turntable or --animate CLIP");
        return;
    }
    const char* option = options.turntable          ? "--turntable"
                         : options.pathFile.empty() ? "--animate"
                                                    : "--path";
    if (!films)
        usage(fmt::format(
            "{}: {}: a name ending in .mp4, or numbered pictures as in frame%04d.png, would be right", option,
            options.output.empty() ? "no --output" : options.output));
    if (!options.statsFile.empty())
        usage(fmt::format("--stats: is of one picture; without {} would be right", option));
    const bool layered = options.output.find('%') != std::string::npos &&
                         io::imageFormatOf(options.output) == io::ImageFormat::Exr;
    if (!options.aovs.empty() && !layered)
        usage(options.output +
              ": --aov: this holds one picture a frame; a name as in frame%04d.exr would be right");
}

void checkFiles(const RenderOptions& options) {
    checkFilm(options);
    if (options.output.empty() && options.radiosity.bakeFile.empty() && !options.script.given())
        usage("--output is required; -o PICTURE.png, for example, would be right");
    if (!options.output.empty() && !isFilm(options)) {
        const io::ImageFormat format = io::imageFormatOf(options.output);
        if (!options.aovs.empty() && format != io::ImageFormat::Exr)
            usage(options.output +
                  ": --aov: this format holds one picture; a name ending in .exr would be right");
    }
    if (!options.radiosity.bakeFile.empty()) {
        const std::string extension = std::filesystem::path(options.radiosity.bakeFile).extension().string();
        if (extension != ".glb" && extension != ".gltf")
            usage("--bake: " + options.radiosity.bakeFile +
                  ": a name ending in .glb or .gltf would be right");
        io::refuseForeignBuffer(options.radiosity.bakeFile, options.overwrite);
    }
    std::vector<std::string> inputs = options.script.files;
    inputs.insert(inputs.end(),
                  {options.scene, options.view.preset, options.view.environment, options.pathFile});
    checkOutputs({{"--output", options.output},
                  {"--bake", options.radiosity.bakeFile},
                  {"--stats", options.statsFile, OutputKind::Json}},
                 inputs);
    if (!options.pathFile.empty())
        hoursOf(readCameraPath(options.pathFile), options.pathFile, options.scene, options.view);
}

// Components asked for: the picture's, then those of the layers; layers of the path tracer alone set what it
// has to keep.
void addComponents(const RenderOptions& options, PictureRequest& request) {
    request.components = {componentOf(options.component)};
    for (const std::string& aov : splitList(options.aovs)) {
        if (!reference::isTracedLayer(aov)) {
            request.components.push_back(componentOf(aov));
            continue;
        }
        if (options.mode != "reference")
            usage("--aov: layer " + aov + " belongs to mode reference; --mode reference would be right");
        request.reference.perBounce = std::max(request.reference.perBounce, reference::bounceLayer(aov));
    }
}

PictureLayers layersOf(const RenderOptions& options, const Picture& picture) {
    PictureLayers layers;
    std::size_t next = 1;
    for (const std::string& aov : splitList(options.aovs)) {
        if (!reference::isTracedLayer(aov))
            layers.emplace_back(aov, picture.images[next++]);
        else if (picture.traced)  // not of a frame that shows nothing
            layers.emplace_back(aov, *reference::layerOf(*picture.traced, aov));
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
    if (request.denoiser != reference::Denoiser::None) json["denoiser"] = options.tracer.denoiser;
    if (picture.baked) json["radiosity"] = bakeJson(*picture.baked);
    if (picture.beams) json["beams"] = beamsJson(*picture.beams);
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
    request.sceneOptions = sceneOptionsOf(options.view);
    request.commands = commandsOf(options.script);
    request.profile = !options.statsFile.empty();
    request.reference = options.tracer.settings();
    request.denoiser = options.tracer.denoises();
    const bool filters = options.mode == "reference" || options.mode == "beams";
    if (filters && !options.tracer.filterGiven() && options.view.stillViews != 0)
        request.reference.filter = reference::PixelFilter::Box;
    // The other modes gather anew for each view: they take as much longer, and have them when asked.
    const std::vector<std::string>& sets = options.view.sets;
    const bool said =
        options.view.stillViews || std::any_of(sets.begin(), sets.end(), [](const std::string& set) {
            return set.rfind("image.antialiasing=", 0) == 0;
        });
    request.tracedViews = said ? 0 : kStillViews;
    request.radiosity = options.radiosity.values;
    request.radiosity.seed = options.tracer.seed;
    request.radiositySpecular = options.radiosity.specular;
    if (options.lampPoints > 0) request.lampPoints = options.lampPoints;
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
    // What they did beside edits is in the settings and the camera.
    if (!session.unsaved()) request.commands.clear();
}

// The film as a command of the console would ask for it.
Request filmRequest(const RenderOptions& options, Session& session) {
    constexpr int kTurntableFrames = 120, kFramesPerSecond = 30;
    Request film{RequestKind::Record, options.output, options.frames};
    film.turntable = options.turntable;
    film.first = options.firstFrame;
    if (!options.clip.empty())
        film.framesPerSecond = std::max(1, static_cast<int>(std::lround(options.framesPerSecond)));
    film.alongPath = !options.pathFile.empty();
    int natural = kTurntableFrames;
    if (film.alongPath) {
        const CameraPath path = readCameraPath(options.pathFile);
        session.setCameraPath(path, "path load");
        natural = 1 + static_cast<int>(std::lround(kFramesPerSecond * (path.end() - path.start())));
    }
    if (film.count == 0) film.count = natural;
    if (!options.framesAreRange || !options.clip.empty()) return film;
    film.total = options.allFrames > 0 ? options.allFrames : natural;
    if (options.firstFrame + options.frames > film.total)
        usage(fmt::format(
            "--frames: '{}' goes beyond the film's {} frames; FIRST-LAST/ALL says how many it has",
            options.frameText, film.total));
    return film;
}

// What moves in the film, and its frames where their number is not given.
void addClip(RenderOptions& options, const io::SceneAnimation& animation) {
    if (options.clip.empty()) return;
    const ClipFilm film = clipFilm(options.scene, animation, options.clip, options.framesPerSecond);
    if (options.frames == 0) options.frames = film.frames;
    options.script.beforeFrame = film.beforeFrame;
}

// A picture without light in it says why, where it should have some.
void explainBlack(const Session& session, const PictureRequest& request, const Image& image) {
    const Component component = request.components.front();
    const bool ofLight = component == Component::Full || component == Component::Direct ||
                         component == Component::Indirect || component == Component::Diffuse ||
                         component == Component::Voxels;
    if (!ofLight || !isBlack(image, request.settings.image)) return;
    Picker picker;
    const std::vector<std::string> reasons = whyBlack(session, picker, &image);
    std::fprintf(stderr, "conelight: the picture is black%s%s\n", reasons.empty() ? "" : ": ",
                 reasons.empty() ? "" : reasons.front().c_str());
}

// --component and --bounces, where the mode has its settings.
void takeComponentAndBounces(const RenderOptions& options, bool onCpu, PictureRequest& request) {
    if (onCpu) {
        constexpr int kMost = 1000;
        if (!options.bounces.empty())
            request.reference.bounces = request.radiosity.bounces = parseBounces(options.bounces, kMost);
    } else {
        if (options.componentGiven)
            request.settings.component = request.components.front();
        else
            request.components.front() = request.settings.component;
        applyBounces(request.settings, options.bounces);
        request.components.front() = request.settings.component;
    }
}

// What there is now and how long it took.
void sayWritten(const RenderOptions& options, const Size& size, std::chrono::steady_clock::time_point since) {
    std::string files;
    if (!options.output.empty() && !isFilm(options))
        files = fmt::format("{} ({} x {} pixels)", options.output, size.width, size.height);
    for (const std::string& more : {options.radiosity.bakeFile, options.statsFile})
        if (!more.empty()) files += (files.empty() ? "" : ", ") + more;
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - since;
    fmt::print("written {}, {}\n", files,
               taken.count() < 10 ? fmt::format("{:.1f} s", taken.count()) : timeText(taken.count()));
}

void run(RenderOptions options) {
    const auto started = std::chrono::steady_clock::now();
    options.mode = modeFor(options.mode, options.view);
    // Everything that can be wrong on the command line is found before the work starts.
    if (!options.mode.empty()) requireModeName(options.mode);
    checkModeOptions(options);
    PictureRequest request = requestOf(options);
    parseFrames(options);
    checkFiles(options);
    Progress progress;
    io::SceneAnimation animation;
    Scene scene = openScene(options.scene, options.view, progress,
                            options.clip.empty() && !options.script.given() ? nullptr : &animation,
                            !options.clip.empty());
    const bool onCpu = !options.mode.empty() && !isRendererMode(options.mode);
    request.settings = settingsFor(scene, onCpu ? "cones" : options.mode, options.view);
    request.mode = onCpu ? options.mode : getSetting(request.settings, "mode");
    request.camera = cameraFor(scene, options.view);
    takeComponentAndBounces(options, onCpu, request);

    PictureSource source(options.view, options.shaderDirectory);
    request.settings.component = request.components.front();
    addClip(options, animation);
    Session session(std::move(scene), options.scene, request.settings, request.mode, request.camera);
    session.setAnimation(std::move(animation));
    session.setOpenHow({options.view.allowOutside, !options.view.noGround, {options.scene, options.view.up}});
    if (isFilm(options)) {
        if (!options.aovs.empty())
            options.script.layers = [&options](const Picture& drawn) { return layersOf(options, drawn); };
        const Request film = filmRequest(options, session);
        if (film.alongPath)
            addHours(options.script.beforeFrame, options.pathFile, session, options.view, film);
        runScript(options.script, session, &source, request, progress, film);
        takeSession(session, request);
        if (options.radiosity.bakeFile.empty()) return;
    } else if (options.script.given()) {
        runScript(options.script, session, &source, request, progress);
        takeSession(session, request);
        if (options.output.empty() && options.radiosity.bakeFile.empty()) return;
    }
    source.setScene(session.scene());
    const Picture picture = source.draw(request, &progress);
    reportBadPixels(picture.images.front());
    explainBlack(session, request, picture.images.front());
    if (!options.output.empty() && !isFilm(options)) {
        progress.show("writing " + options.output);
        writePicture(options.output, picture.images.front(), request.settings.image,
                     provenanceOf(request, session.path(), source.device()), layersOf(options, picture));
    }
    if (!options.radiosity.bakeFile.empty()) {
        progress.show("writing " + options.radiosity.bakeFile);
        const WritingScope writing;
        io::writeGltf(options.radiosity.bakeFile, source.bakedScene(request.radiosity, &progress),
                      options.overwrite);
    }
    if (!options.statsFile.empty()) writeJson(options.statsFile, statsOf(options, request, picture));
    progress.finish();
    if (picture.stopped) endStopped(options, request, picture);
    sayWritten(options, request.size, started);
}

void addFilmOptions(CLI::App& command, RenderOptions& options) {
    command
        .add_option("--path", options.pathFile,
                    "a film along the camera path of this file (docs/reference/camera_path.md)")
        ->type_name("FILE");
    command
        .add_option("--animate", options.clip,
                    "a film of this clip of a glTF file, by name or number (`conelight info` lists them)")
        ->type_name("CLIP");
    command.add_option("--fps", options.framesPerSecond, "--animate: frames a second of the clip")
        ->capture_default_str()
        ->check(CLI::Range(0.01, 1000.0));
    command.add_flag("--turntable", options.turntable, "a film once round what the camera looks at");
    command
        .add_option("--frames", options.frameText,
                    "frames of the film (default: 30 a second of the path; turntable 120; the whole clip); "
                    "or a part of them, FIRST-LAST or FIRST-LAST/ALL, counted from 0")
        ->type_name("N");
}

// Of the modes that run on the CPU.
void addCpuOptions(CLI::App& command, RenderOptions& options) {
    options.tracer.addTo(
        command, "modes reference and beams: box (a pixel's area, the default) or center (one point of it)");
    options.tracer.addDenoiseTo(command);
    options.radiosity.addTo(command);
    command
        .add_option("--lamp-points", options.lampPoints,
                    "mode beams: lamps with an area become so many points along each side (default 4)")
        ->type_name("N")
        ->check(CLI::Range(1, 16));
}

}  // namespace

void addRender(CLI::App& app) {
    auto options = std::make_shared<RenderOptions>();
    CLI::App* command = app.add_subcommand("render", "draw a scene to a picture file, without a display");
    command
        ->add_option("scene", options->scene,
                     "a scene file, or builtin:NAME (`conelight info builtin:` lists them)")
        ->required();
    command->add_option(
        "-o,--output", options->output,
        "picture: .png .jpg (tone-mapped), .exr .hdr (linear radiance); with --path or --turntable a film: "
        ".mp4, or numbered pictures as in frame%04d.png");
    addFilmOptions(*command, *options);
    command->add_flag("--overwrite", options->overwrite,
                      "--bake NAME.gltf may replace a NAME.bin that belongs to another file");
    command->add_option("--mode", options->mode, modeNames() + " (default traced)");
    command
        ->add_option(
            "--component", options->component,
            "full, direct, indirect, diffuse or specular; but for modes reference and beams also occlusion, "
            "albedo, normal, depth, voxels or emission")
        ->capture_default_str();
    command
        ->add_option(
            "--bounces", options->bounces,
            "indirect bounces, or all: 0 = direct light and emission seen; modes cones and hybrid: 0 to "
            "8, all is 8; traced: 0 to 15 or all; modes reference, radiosity and beams: any number, all "
            "is the default; mode beams counts mirrors")
        ->type_name("N");
    command
        ->add_option(
            "--aa", options->view.stillViews,
            "smooth edges: views at offsets within a pixel, whose mean is the picture; 0: one view, of the "
            "pixels' centres (image.antialiasing; default 16 in mode traced, else 0; modes reference "
            "and beams: --filter)")
        ->type_name("N")
        ->check(CLI::Range(0, 64));
    command
        ->add_option("--aov", options->aovs,
                     "components that become further layers of an .exr, or of each frame%04d.exr, "
                     "comma-separated; mode reference: "
                     "also " +
                         reference::tracedLayerNames())
        ->type_name("A,B");
    command
        ->add_option("--stats", options->statsFile,
                     "write passes, lookups per pixel and memory, or samples, noise and rays, as JSON")
        ->type_name("FILE");
    command
        ->add_option("--shader-dir", options->shaderDirectory,
                     "shaders from this folder instead of the built-in ones")
        ->type_name("DIR");
    addCpuOptions(*command, *options);
    options->view.addTo(*command);
    options->script.addTo(*command);
    command->callback([options, command] {
        options->componentGiven = command->count("--component") > 0;
        run(*options);
    });
}

}  // namespace conelight::program
