// SPDX-License-Identifier: MIT
// `conelight score edges`: stairs at edges and how they flicker, without and with image.temporal, against anti-aliased
// stills of the same mode.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

#include "reference/scores.h"
#include "score.h"

namespace conelight::program {
namespace {

constexpr int kTruthViews = 64;

struct EdgesOptions : ScoreOptions {
    int frames = 32;
    double pan = 0.1;  // pixels a frame
    std::string component = "direct";
};

// Aside, so that what the target is beside moves by so many pixels.
Camera aside(Camera camera, double pixels, const Size& size) {
    const glm::vec3 view = camera.target - camera.eye;
    const glm::vec3 right = glm::normalize(glm::cross(view, camera.up));
    const double pixel = static_cast<double>(camera.heightAt(glm::length(view))) / size.height;
    const glm::vec3 step = static_cast<float>(pixels * pixel) * right;
    camera.eye += step;
    camera.target += step;
    return camera;
}

// Frames of a way, drawn one after the other.
struct EdgeFilm {
    std::vector<Image> images;

    EdgeFilm(PictureSource& source, PictureRequest request, double pan, int frames, Progress& progress) {
        const Camera start = request.camera;
        for (int i = 0; i < frames; ++i) {
            request.camera = aside(start, pan * i, request.size);
            images.push_back(source.draw(request, &progress).images.front());
        }
    }
};

double meanOf(const Image& image) {
    double sum = 0;
    for (const glm::vec4& pixel : image.pixels) sum += static_cast<double>(pixel.r + pixel.g + pixel.b);
    return sum / (3.0 * static_cast<double>(image.pixels.size()));
}

// RMS of the change of the error from each frame to the next / mean of the truth; the first quarter is left out.
double flickerOf(const std::vector<Image>& images, const std::vector<Image>& truths) {
    double square = 0, mean = 0;
    std::size_t count = 0;
    for (std::size_t f = std::max<std::size_t>(images.size() / 4, 1); f < images.size(); ++f) {
        mean += meanOf(truths[f]);
        ++count;
        double sum = 0;
        for (std::size_t i = 0; i < images[f].pixels.size(); ++i) {
            const glm::dvec3 now(images[f].pixels[i] - truths[f].pixels[i]);
            const glm::dvec3 before(images[f - 1].pixels[i] - truths[f - 1].pixels[i]);
            sum += glm::dot(now - before, now - before) / 3;
        }
        square += sum / static_cast<double>(images[f].pixels.size());
    }
    return std::sqrt(square / static_cast<double>(count)) / (mean / static_cast<double>(count));
}

struct Edges {
    double stairs = 0, rest = 0;            // relRMSE of a view at rest
    double flickerBefore = 0, flicker = 0;  // on the way
};

Edges edgesOf(PictureSource& source, PictureRequest request, const EdgesOptions& options,
              Progress& progress) {
    PictureRequest truth = request, plain = request, smooth = request;
    truth.settings.image.antialiasing = kTruthViews;
    truth.settings.image.temporal = plain.settings.image.temporal = Toggle::Off;
    truth.settings.traced.budgeted = false;
    plain.settings.image.antialiasing = 0;
    smooth.settings.image.temporal = Toggle::On;
    plain.settings.traced.budgeted = smooth.settings.traced.budgeted = true;
    const EdgeFilm truths(source, truth, options.pan, options.frames, progress);
    const EdgeFilm stairs(source, plain, options.pan, options.frames, progress);
    const EdgeFilm moving(source, smooth, options.pan, options.frames, progress);
    const EdgeFilm settled(source, plain, 0, 1, progress);  // forgets the way
    const EdgeFilm resting(source, smooth, 0, options.frames, progress);
    return {reference::relativeDifference(settled.images.front(), truths.images.front()),
            reference::relativeDifference(resting.images.back(), truths.images.front()),
            flickerOf(stairs.images, truths.images), flickerOf(moving.images, truths.images)};
}

void run(const EdgesOptions& options) {
    const std::vector<Variant> variants = options.checked("edges", true);
    PictureSource source(options.view);
    ScoreReport report("edges", "RMS error / mean radiance of the anti-aliased still", options);
    Table table({"scene", "mode", "at rest, without", "with", "flicker, without", "with"});
    Progress progress;
    for (const std::string& path : options.scenes) {
        const Scene scene = openScene(path, options.view, progress);
        source.setScene(scene);
        for (const Variant& variant : variants) {
            PictureRequest request = requestOf(variant, scene, options.view);
            request.components = {componentOf(options.component)};
            const Edges edges = edgesOf(source, request, options, progress);
            table.add({path, variant.label(), percent(edges.stairs), percent(edges.rest),
                       percent(edges.flickerBefore), percent(edges.flicker)});
            report.add(path + " " + variant.label(), edges.rest,
                       {{"scene", path},
                        {"variant", variant.label()},
                        {"component", options.component},
                        {"frames", options.frames},
                        {"pan_pixels", options.pan},
                        {"rest_without", edges.stairs},
                        {"rest", edges.rest},
                        {"flicker_without", edges.flickerBefore},
                        {"flicker", edges.flicker}});
        }
    }
    progress.finish();
    table.print(2);
    report.finish(source.device());
}

}  // namespace

void addScoreEdges(CLI::App& score) {
    auto options = std::make_shared<EdgesOptions>();
    CLI::App* command = score.add_subcommand(
        "edges", "stairs at edges and how they flicker, without and with image.temporal");
    command->add_option("scenes", options->scenes, "scene files or builtin:NAME")->required();
    command->add_option("--frames", options->frames, "of the view at rest, and along the way")
        ->capture_default_str()
        ->check(CLI::Range(4, 1000));
    command->add_option("--pan", options->pan, "how far the camera moves aside in a frame, pixels")
        ->capture_default_str()
        ->check(CLI::Range(0.0, 100.0));
    command->add_option("--component", options->component, "full, direct, indirect, diffuse or specular")
        ->capture_default_str();
    options->addTo(*command, "phong", "160x120");
    command->callback([options] { run(*options); });
}

}  // namespace conelight::program
