// SPDX-License-Identifier: MIT
// `conelight bench SCENE...`: what a frame costs, per pass, as medians. Modes run in turn within one process
// (A B A B ...), so that their ratios hold on a noisy machine. On a software driver the figure to compare is
// process CPU time; GPU times come from timer queries elsewhere.
#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>

#include "command.h"
#include "conelight/error.h"
#include "conelight/shaders.h"
#include "outputs.h"
#include "scene_upload.h"
#include "script_run.h"
#include "static_light.h"
#include "stats_json.h"

namespace conelight::program {
namespace {

struct BenchOptions {
    std::vector<std::string> scenes;
    std::string modes = "traced";
    std::string jsonFile;
    std::string shaders;  // folder
    std::string shaderDirectory;
    int frames = 5;
    bool dynamic = false;
    std::string moving;  // name or index of an instance; empty: none
    std::string clip;    // empty: none
    ViewOptions view;
    ScriptOptions script;
};

struct Spread {
    double median, min, max;
};

Spread spread(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const std::size_t n = values.size();
    const double median = n % 2 == 1 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
    return {median, values.front(), values.back()};
}

nlohmann::ordered_json spreadJson(const Spread& s) {
    return {{"median", s.median}, {"min", s.min}, {"max", s.max}};
}

// The frames of one mode.
struct Run {
    std::string mode;
    Settings settings;
    std::vector<FrameStats> frames;
    FrameStats counted;                     // one extra frame with lookups counted
    std::vector<DispatchStats> dispatches;  // of another, with --shaders
    std::shared_ptr<const BakedLight> baked;

    Spread of(double FrameStats::*field) const {
        std::vector<double> values;
        for (const FrameStats& frame : frames) values.push_back(frame.*field);
        return spread(values);
    }
    // Passes in order of first appearance; those of equal name within a frame are added up.
    std::vector<std::pair<std::string, std::pair<double, double>>> passes() const {
        std::vector<std::string> order;
        std::map<std::string, std::vector<double>> cpu, gpu;
        for (const FrameStats& frame : frames) {
            std::map<std::string, std::pair<double, double>> sums;
            for (const PassStats& pass : frame.passes) {
                if (cpu.find(pass.name) == cpu.end()) order.push_back(pass.name);
                cpu[pass.name];
                sums[pass.name].first += pass.cpuMs;
                sums[pass.name].second += pass.gpuMs;
            }
            for (const auto& [name, sum] : sums) {
                cpu[name].push_back(sum.first);
                gpu[name].push_back(sum.second);
            }
        }
        std::vector<std::pair<std::string, std::pair<double, double>>> result;
        for (const std::string& name : order)
            result.push_back({name, {spread(cpu[name]).median, spread(gpu[name]).median}});
        return result;
    }
};

// Of frames, for the GPU.
Spread waitsOf(const Run& run) {
    std::vector<double> values;
    for (const FrameStats& frame : run.frames) values.push_back(static_cast<double>(frame.waits));
    return spread(values);
}

void printRun(const std::string& scene, const BenchOptions& options, const Run& run) {
    const Spread cpu = run.of(&FrameStats::cpuMs);
    const Spread wall = run.of(&FrameStats::wallMs);
    const std::string moves = !options.moving.empty() ? "  moving " + options.moving
                              : !options.clip.empty() ? "  clip " + options.clip
                                                      : "";
    fmt::print("{}  mode {}  {}  {} voxels{}{}  {} frames\n", scene, run.mode, options.view.size,
               run.settings.voxels.size, options.dynamic ? "  dynamic" : "", moves, options.frames);
    fmt::print("  {:<28} cpu {:9.2f} ms ({:.2f} .. {:.2f})   wall {:9.2f} ms\n", "frame", cpu.median, cpu.min,
               cpu.max, wall.median);
    for (const auto& [name, time] : run.passes()) {
        fmt::print("  {:<28} cpu {:9.2f} ms", name, time.first);
        if (time.second >= 0) fmt::print("   gpu {:9.3f} ms", time.second);
        fmt::print("\n");
    }
    for (const auto& [kind, count] : run.counted.lookupsPerPixel)
        if (count > 0) fmt::print("  {:<28} {:13.1f} per pixel\n", "lookups " + kind, count);
    const Spread waits = waitsOf(run);
    fmt::print("  {:<28} {:13.0f} per frame ({:.0f} .. {:.0f})\n", "waits", waits.median, waits.min,
               waits.max);
    std::size_t total = 0;
    for (const MemoryStats& object : run.frames.back().memory) total += object.bytes;
    fmt::print("  {:<28} {:13.1f} MB\n", "GL objects", static_cast<double>(total) / 1e6);
}

nlohmann::ordered_json runJson(const std::string& scene, const BenchOptions& options, const Size& size,
                               const Run& run) {
    nlohmann::ordered_json json;
    json["scene"] = scene;
    json["mode"] = run.mode;
    json["quality"] = nullptr;
    if (run.settings.mode == Mode::Traced) json["quality"] = getSetting(run.settings, "traced.quality");
    json["voxels"] = run.settings.voxels.size;
    json["size"] = {size.width, size.height};
    json["dynamic"] = options.dynamic;
    json["moving"] =
        options.moving.empty() ? nlohmann::ordered_json() : nlohmann::ordered_json(options.moving);
    json["clip"] = options.clip.empty() ? nlohmann::ordered_json() : nlohmann::ordered_json(options.clip);
    const bool onGpu = !run.frames.front().passes.empty() && run.frames.front().passes.front().gpuMs >= 0;
    json["frame"] = {{"cpu_ms", spreadJson(run.of(&FrameStats::cpuMs))},
                     {"wall_ms", spreadJson(run.of(&FrameStats::wallMs))}};
    json["frame"]["waits"] = spreadJson(waitsOf(run));
    json["frame"]["gpu_ms"] = nullptr;
    if (onGpu) {
        std::vector<double> sums;
        for (const FrameStats& frame : run.frames) {
            double sum = 0;
            for (const PassStats& pass : frame.passes) sum += std::max(pass.gpuMs, 0.0);
            sums.push_back(sum);
        }
        json["frame"]["gpu_ms"] = spreadJson(spread(sums));
    }
    json["passes"] = nlohmann::ordered_json::array();
    for (const auto& [name, time] : run.passes())
        json["passes"].push_back(
            {{"name", name},
             {"cpu_ms", time.first},
             {"gpu_ms", onGpu ? nlohmann::ordered_json(time.second) : nlohmann::ordered_json()}});
    json["lookups_per_pixel"] = lookupsJson(run.counted);
    if (!run.dispatches.empty()) json["dispatches"] = nlohmann::ordered_json::array();
    for (const DispatchStats& one : run.dispatches)
        json["dispatches"].push_back({{"pass", one.pass},
                                      {"program", one.program},
                                      {"dispatches", one.dispatches},
                                      {"invocations", one.invocations}});
    json["memory_bytes"] = memoryJson(run.frames.back());
    return json;
}

// The instance of that name, else of that index.
std::size_t findInstance(const Scene& scene, const std::string& path, const std::string& wanted) {
    for (std::size_t i = 0; i < scene.instances.size(); ++i)
        if (scene.instances[i].name == wanted) return i;
    std::size_t index = 0;
    const auto [end, error] = std::from_chars(wanted.data(), wanted.data() + wanted.size(), index);
    if (error == std::errc() && end == wanted.data() + wanted.size() && index < scene.instances.size())
        return index;
    throw Error(ErrorKind::Usage,
                fmt::format("--moving: {} has no instance '{}'; a name, or an index below {}, would be right",
                            path, wanted, scene.instances.size()));
}

// One instance's place in a frame: to and fro by a hundredth of the scene, more than a voxel from 128 on.
Instance movedInstance(const Scene& scene, std::size_t index, int frame) {
    Instance instance = scene.instances[index];
    const glm::vec3 extent = scene.bounds().extent();
    const float longest = std::max({extent.x, extent.y, extent.z});
    instance.worldFromObject[3].x += (frame % 2 == 0 ? 0.01f : 0.0f) * longest;
    return instance;
}

std::size_t benchedClip(const io::SceneAnimation& animation, const std::string& path,
                        const std::string& wanted) {
    try {
        return io::clipNumber(animation, wanted);
    } catch (const Error& error) {
        throw Error(error.kind(), path + ": --animate: " + error.what());
    }
}

// Thirty frames a second, from its start again and again.
double clipSeconds(const io::AnimationClip& clip, int frame) {
    const double seconds = double(frame) / 30, duration = double(clip.duration);
    return duration > 0 ? std::fmod(seconds, duration) : 0;
}

// Mode hybrid: light of what does not move, `moving` not counted among it; else none.
std::shared_ptr<const BakedLight> bakedFor(const Run& run, const Scene& scene, const std::string& path,
                                           const std::string& moving, Progress& progress) {
    if (run.settings.mode != Mode::Hybrid) return nullptr;
    Scene marked = scene;
    if (!moving.empty()) marked.instances[findInstance(marked, path, moving)].dynamic = true;
    reference::RadiositySettings settings;
    settings.emissiveQuads = run.settings.light.emissiveQuads;
    StaticBake bake;
    return staticLight(bake, marked, settings, &progress);
}

// The scene as the commands of --exec and --script leave it, in one mode.
std::unique_ptr<Session> sessionFor(const Scene& scene, const Camera& camera, const std::string& path,
                                    const std::string& mode, const BenchOptions& options,
                                    Progress& progress) {
    auto session =
        std::make_unique<Session>(scene, path, settingsFor(scene, mode, options.view), mode, camera);
    const PictureRequest none;
    runScript(options.script, *session, nullptr, none, progress);
    if (session->shownMode() != mode)
        throw Error(ErrorKind::Usage, fmt::format("--exec: changes the mode to {}; --modes {} would be right",
                                                  session->shownMode(), session->shownMode()));
    return session;
}

// All modes of one scene, frame by frame in turn. Each mode has its own renderer, so that switching does not
// rebuild volumes.
std::vector<Run> benchScene(const std::string& path, const BenchOptions& options, const Size& size,
                            const std::vector<std::string>& modes, Progress& progress) {
    io::SceneAnimation animation;
    const bool plays = !options.clip.empty();
    const Scene scene = openScene(path, options.view, progress, plays ? &animation : nullptr, plays);
    const std::size_t clip = plays ? benchedClip(animation, path, options.clip) : 0;
    const Camera camera = cameraFor(scene, options.view);
    std::vector<std::unique_ptr<Session>> sessions;
    std::vector<SceneUpload> uploads(modes.size());
    std::vector<Run> runs;
    std::vector<std::unique_ptr<Renderer>> renderers;
    for (const std::string& mode : modes) {
        sessions.push_back(sessionFor(scene, camera, path, mode, options, progress));
        if (!options.moving.empty()) findInstance(sessions.back()->scene(), path, options.moving);
        sessions.back()->setAnimation(animation);
        runs.push_back({mode, sessions.back()->shownSettings(), {}, {}, {}, nullptr});
        Renderer& renderer = *renderers.emplace_back(
            std::make_unique<Renderer>(rendererOptions(options.view, options.shaderDirectory)));
        uploads[runs.size() - 1].follow(renderer, *sessions.back());
        runs.back().baked = bakedFor(runs.back(), sessions.back()->scene(), path, options.moving, progress);
        renderer.setBakedLight(runs.back().baked);
        Settings& settings = runs.back().settings;
        // A frame of a moving picture is timed: with light settled first, or with all light made anew in
        // each.
        progress.show(fmt::format("{}: {}: settling", path, mode));
        renderer.render(sessions.back()->camera(), size.width, size.height, settings);
        settings.traced.budgeted = true;
        renderer.setDynamic(options.dynamic || sessions.back()->flags().dynamic);
        // Warm up: shaders are compiled at their first use, per state; then the frame that counts lookups.
        progress.show(fmt::format("{}: {}: warming up", path, mode));
        renderer.setProfiling(true, false);
        renderer.render(sessions.back()->camera(), size.width, size.height, runs.back().settings);
        renderer.setProfiling(true, true);
        renderer.render(sessions.back()->camera(), size.width, size.height, runs.back().settings);
        runs.back().counted = renderer.stats();
        if (!options.shaders.empty()) {
            renderer.setProfiling(true, false, true);
            renderer.render(sessions.back()->camera(), size.width, size.height, runs.back().settings);
            runs.back().dispatches = renderer.stats().dispatches;
        }
        renderer.setProfiling(true, false);
    }
    for (int frame = 0; frame < options.frames; ++frame) {
        for (std::size_t i = 0; i < runs.size(); ++i) {
            progress.show(
                fmt::format("{}: {}: frame {} of {}", path, runs[i].mode, frame + 1, options.frames));
            if (!options.moving.empty()) {
                const Scene& moved = sessions[i]->scene();
                const std::size_t moving = findInstance(moved, path, options.moving);
                renderers[i]->setInstance(moving, movedInstance(moved, moving, frame));
            }
            if (plays) sessions[i]->poseClip(clip, clipSeconds(animation.clips[clip], frame));
            uploads[i].follow(*renderers[i], *sessions[i]);
            renderers[i]->render(sessions[i]->camera(), size.width, size.height, runs[i].settings);
            runs[i].frames.push_back(renderers[i]->stats());
        }
    }
    progress.finish();
    return runs;
}

void run(const BenchOptions& options) {
    const Size size = parseSize(options.view.size);
    std::vector<std::string> modes;
    for (std::size_t from = 0; from <= options.modes.size();) {
        const std::size_t comma = std::min(options.modes.find(',', from), options.modes.size());
        modes.push_back(options.modes.substr(from, comma - from));
        Settings probe;
        setSetting(probe, "mode", modes.back());
        from = comma + 1;
    }
    std::vector<std::string> inputs = options.scenes;
    inputs.insert(inputs.end(), {options.view.preset, options.view.environment});
    checkOutputs({{"--json", options.jsonFile, OutputKind::Json}}, inputs);
    const std::unique_ptr<platform::HeadlessContext> context = openContext(options.view);
    Progress progress;
    nlohmann::ordered_json json;
    json["version"] = 1;
    json["device"] = {{"description", context->description()}};
    json["runs"] = nlohmann::ordered_json::array();
    for (const std::string& scene : options.scenes) {
        for (const Run& one : benchScene(scene, options, size, modes, progress)) {
            printRun(scene, options, one);
            json["runs"].push_back(runJson(scene, options, size, one));
        }
    }
    if (!options.jsonFile.empty()) writeJson(options.jsonFile, json);
    if (!options.shaders.empty())
        expandBuiltShaders(options.shaders, rendererOptions(options.view, "").execution);
}

}  // namespace

void addBench(CLI::App& app) {
    auto options = std::make_shared<BenchOptions>();
    CLI::App* command =
        app.add_subcommand("bench", "what a frame costs: time per pass, lookups per pixel, memory");
    command->add_option("scenes", options->scenes, "scene files or builtin:NAME")->required();
    command->add_option("--modes", options->modes, "modes to run in turn, comma-separated")
        ->capture_default_str()
        ->type_name("A,B");
    command->add_option("--frames", options->frames, "frames that are measured")
        ->capture_default_str()
        ->check(CLI::Range(1, 10000));
    command->add_flag("--dynamic", options->dynamic, "voxelize and light everything anew each frame");
    command
        ->add_option("--moving", options->moving,
                     "move this instance (name or index) before each frame; what it does not touch is kept")
        ->type_name("INSTANCE");
    command
        ->add_option("--animate", options->clip,
                     "play this clip (name or number, `conelight info` lists them) at 30 frames a second")
        ->type_name("CLIP")
        ->excludes("--moving");
    command->add_option("--json", options->jsonFile, "write the figures as JSON")->type_name("FILE");
    command
        ->add_option("--shaders", options->shaders,
                     "write the shaders that the frames needed, as text; --json then says how often each ran")
        ->type_name("DIR");
    command
        ->add_option("--shader-dir", options->shaderDirectory,
                     "shaders from this folder instead of the built-in ones")
        ->type_name("DIR");
    options->view.addTo(*command);
    options->script.addTo(*command);
    command->callback([options] { run(*options); });
}

}  // namespace conelight::program
