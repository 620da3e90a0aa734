// SPDX-License-Identifier: MIT
// `conelight score flicker`: error that comes and goes along a path of the camera or of an object.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <glm/gtc/matrix_transform.hpp>

#include "conelight/error.h"
#include "reference/scores.h"
#include "reference_file.h"
#include "score.h"

namespace conelight::program {
namespace {

struct FlickerOptions : ScoreOptions {
    std::string path = "orbit=4";
    int frames = 8;
    std::string component = "indirect";
    std::string cache;
    TracerOptions tracer;
};

// orbit=DEG: about the target; dolly=PART: that part of the way to the target; object=NAME:X,Y,Z: in metres.
struct Path {
    enum class Kind { Orbit, Dolly, Object } kind = Kind::Orbit;
    float amount = 0;
    std::string object;
    glm::vec3 travel{0};
};

[[noreturn]] void badPath(const std::string& text) {
    throw Error(ErrorKind::Usage, "--path: '" + text +
                                      "' is not usable; orbit=DEGREES, dolly=PART or "
                                      "object=NAME:X,Y,Z would be right");
}

Path parsePath(const std::string& text) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos) badPath(text);
    const std::string kind = text.substr(0, equals), value = text.substr(equals + 1);
    Path path;
    if (kind == "object") {
        const std::size_t colon = value.rfind(':');
        if (colon == std::string::npos) badPath(text);
        path.kind = Path::Kind::Object;
        path.object = value.substr(0, colon);
        path.travel = parseVec3("--path", value.substr(colon + 1));
        return path;
    }
    char* end = nullptr;
    path.amount = std::strtof(value.c_str(), &end);
    if (value.empty() || *end != '\0' || !std::isfinite(path.amount)) badPath(text);
    if (kind == "dolly" && path.amount < 1)
        path.kind = Path::Kind::Dolly;
    else if (kind != "orbit")
        badPath(text);
    return path;
}

// Scene and camera at `t` in [0,1] of the path.
Camera cameraAt(const Path& path, Camera camera, float t) {
    const glm::vec3 arm = camera.eye - camera.target;
    if (path.kind == Path::Kind::Orbit)
        camera.eye = camera.target + glm::vec3(glm::rotate(glm::mat4(1), glm::radians(path.amount * t),
                                                           glm::normalize(camera.up)) *
                                               glm::vec4(arm, 0));
    if (path.kind == Path::Kind::Dolly) camera.eye = camera.target + (1 - path.amount * t) * arm;
    return camera;
}

Scene sceneAt(const Path& path, const Scene& scene, float t) {
    Scene moved = scene;
    if (path.kind != Path::Kind::Object) return moved;
    bool found = false;
    for (Instance& instance : moved.instances) {
        if (instance.name != path.object) continue;
        instance.worldFromObject = glm::translate(glm::mat4(1), t * path.travel) * instance.worldFromObject;
        found = true;
    }
    if (!found)
        throw Error(ErrorKind::Usage, "--path: the scene has no object '" + path.object +
                                          "'; a name that `conelight info SCENE` lists would be right");
    return moved;
}

// All frames of one scene: reference and depth first, then each variant's pictures in its own renderer.
struct Flicker {
    const FlickerOptions& options;
    const Path path;
    Component component;
    Progress& progress;
    std::vector<Scene> scenes;  // one when only the camera moves
    std::vector<reference::FlickerFrame> frames;
    int samples = 0;

    const Scene& sceneOf(std::size_t frame) const { return scenes[scenes.size() == 1 ? 0 : frame]; }

    void prepare(const Scene& scene) {
        PictureSource source(options.view);
        const Camera start = cameraFor(scene, options.view);
        const std::size_t count = static_cast<std::size_t>(options.frames);
        const bool moves = path.kind == Path::Kind::Object;
        for (std::size_t f = 0; f < count; ++f) {
            const float t = static_cast<float>(f) / static_cast<float>(count - 1);
            if (moves || f == 0) scenes.push_back(sceneAt(path, scene, t));
        }
        for (std::size_t f = 0; f < count; ++f) {
            const float t = static_cast<float>(f) / static_cast<float>(count - 1);
            if (moves || f == 0) source.setScene(sceneOf(f));
            PictureRequest request;
            request.size = parseSize(options.view.size);
            request.camera = cameraAt(path, start, t);
            request.reference = options.tracer.settings();
            progress.show(fmt::format("reference of frame {} of {}", f + 1, count));
            const ReferencePicture truth =
                referenceFor(source, sceneOf(f), request, options.cache, "flicker", &progress);
            samples = truth.samplesPerPixel;
            request.components = {Component::Depth};
            reference::FlickerFrame frame;
            frame.camera = request.camera;
            frame.depth = source.draw(request, &progress).images.front();
            frame.halfA = component == Component::Full ? truth.halfA : truth.indirectA;
            frame.halfB = component == Component::Full ? truth.halfB : truth.indirectB;
            frames.push_back(std::move(frame));
        }
    }

    // In order, as an animation that starts settled: what a mode keeps over frames takes part.
    void draw(PictureSource& source, const Variant& variant) {
        for (std::size_t f = 0; f < frames.size(); ++f) {
            if (f == 0)
                source.setScene(sceneOf(f));
            else if (scenes.size() > 1)
                source.moveInstances(sceneOf(f));
            PictureRequest request;
            request.mode = variant.mode;
            request.settings = variant.settingsFor(sceneOf(f), options.view);
            request.camera = frames[f].camera;
            request.size = parseSize(options.view.size);
            request.components = {component};
            request.reference = options.tracer.settings();
            request.settings.traced.budgeted = f > 0;
            frames[f].test = source.draw(request, &progress).images.front();
        }
    }
};

void run(const FlickerOptions& options) {
    const std::vector<Variant> variants = options.checked("flicker", false);
    const Path path = parsePath(options.path);
    if (options.component != "full" && options.component != "indirect")
        throw Error(ErrorKind::Usage, "--component: '" + options.component +
                                          "' is not usable; full or indirect would be right");
    ScoreReport report("flicker", "high-pass error / mean radiance of the reference", options);
    Table table({"scene", "mode", "flicker", "noise floor", "worst frame", "pixels followed", "reference"});
    Progress progress;
    std::string device;
    for (const std::string& name : options.scenes) {
        const Scene scene = openScene(name, options.view, progress);
        Flicker flicker{options, path, componentOf(options.component), progress, {}, {}, 0};
        flicker.prepare(scene);
        for (const Variant& variant : variants) {
            PictureSource source(options.view);
            flicker.draw(source, variant);
            device = source.device();
            const reference::FlickerScore score = reference::flickerScore(flicker.frames);
            const double worst = *std::max_element(score.each.begin(), score.each.end());
            table.add({name, variant.label(), percent(score.flicker), percent(score.floor), percent(worst),
                       percent(score.pixelsUsed), fmt::format("{} spp", flicker.samples)});
            report.add(name + " " + variant.label(), score.flicker,
                       {{"scene", name},
                        {"variant", variant.label()},
                        {"path", options.path},
                        {"component", options.component},
                        {"frames", options.frames},
                        {"flicker", score.flicker},
                        {"noise_floor", score.floor},
                        {"each", score.each},
                        {"pixels_followed", score.pixelsUsed},
                        {"reference_mean", score.mean},
                        {"reference_samples_per_pixel", flicker.samples}});
        }
    }
    progress.finish();
    table.print(2);
    report.finish(device);
}

}  // namespace

void addScoreFlicker(CLI::App& score) {
    auto options = std::make_shared<FlickerOptions>();
    CLI::App* command = score.add_subcommand(
        "flicker", "error that comes and goes along a path of the camera or of an object");
    command->add_option("scenes", options->scenes, "scene files or builtin:NAME")->required();
    command
        ->add_option("--path", options->path,
                     "orbit=DEGREES about the target, dolly=PART of the way to it, or object=NAME:X,Y,Z in m")
        ->capture_default_str()
        ->type_name("PATH");
    command->add_option("--frames", options->frames, "along the path")
        ->capture_default_str()
        ->check(CLI::Range(3, 1000));
    command->add_option("--component", options->component, "full or indirect")->capture_default_str();
    command->add_option("--cache", options->cache, "folder in which reference pictures are kept")
        ->type_name("DIR");
    options->tracer.addTo(
        *command,
        "mode reference: center (a point per pixel, as the other modes; the default) or box "
        "(its area)");
    options->addTo(*command, "cones", "160x120");
    command->callback([options] { run(*options); });
}

}  // namespace conelight::program
