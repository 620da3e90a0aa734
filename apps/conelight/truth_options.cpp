// SPDX-License-Identifier: MIT
#include "truth_options.h"

#include <fmt/core.h>

#include <cmath>
#include <cstdlib>
#include <initializer_list>

#include "conelight/error.h"

namespace conelight::program {
namespace {

// With --noise alone: more samples than any picture here needs; the noise ends it.
constexpr int kSamplesUntilQuiet = 65536;

std::string firstGiven(const CLI::App* command, std::initializer_list<const char*> names) {
    for (const char* name : names)
        if (command != nullptr && command->get_option_no_throw(name) != nullptr && command->count(name) > 0)
            return name;
    return {};
}

}  // namespace

double parseFraction(const std::string& option, const std::string& text) {
    char* end = nullptr;
    double value = std::strtod(text.c_str(), &end);
    const bool read = end != text.c_str();
    if (read && *end == '%') {
        value /= 100;
        ++end;
    }
    if (!read || *end != '\0' || !std::isfinite(value) || value < 0)
        throw Error(
            ErrorKind::Usage,
            fmt::format("{}: '{}' is not a fraction; 0.01 or 1%, for example, would be right", option, text));
    return value;
}

void TracerOptions::addTo(CLI::App& command, const std::string& filterHelp) {
    command_ = &command;
    command
        .add_option("--spp", samples,
                    "mode reference: samples per pixel (default 256; with --noise, as many as it takes)")
        ->type_name("N")
        ->check(CLI::Range(1, 1 << 20));
    command
        .add_option("--noise", noise, "mode reference: stop when the noise is below, as relRMSE; 1% or 0.01")
        ->type_name("X");
    command.add_option("--seed", seed, "modes reference, radiosity and hybrid: of the random numbers")
        ->capture_default_str()
        ->type_name("N");
    command.add_option("--filter", filter, filterHelp)->type_name("NAME");
    command
        .add_option(
            "--paths", paths,
            "mode reference: all, or mirrors: direct light, straight and in ideal mirrors, as mode beams "
            "has it")
        ->capture_default_str()
        ->type_name("NAME");
}

void TracerOptions::addDenoiseTo(CLI::App& command) {
    command_ = &command;
    command
        .add_flag(
            "--denoise{own}", denoiser,
            "mode reference: take out noise; --denoise=oidn by Open Image Denoise, where it is built in")
        ->type_name("NAME");
}

reference::Denoiser TracerOptions::denoises() const {
    if (denoiser.empty()) return reference::Denoiser::None;
    if (denoiser == "own") return reference::Denoiser::Own;
    if (denoiser != "oidn")
        throw Error(ErrorKind::Usage,
                    "--denoise: '" + denoiser + "' is not usable; own or oidn would be right");
    if (!reference::hasOidn())
        throw Error(ErrorKind::Usage, "--denoise: this build has no Open Image Denoise; own would be right");
    return reference::Denoiser::Oidn;
}

reference::PathTracerSettings TracerOptions::settings() const {
    reference::PathTracerSettings result;
    result.seed = seed;
    if (!noise.empty()) {
        result.noise = parseFraction("--noise", noise);
        if (!(result.noise > 0))
            throw Error(ErrorKind::Usage, "--noise: 0 would take for ever; 1%, for example, would be right");
        result.samplesPerPixel = kSamplesUntilQuiet;
    }
    if (samples > 0) result.samplesPerPixel = samples;
    if (filter != "center" && filter != "box")
        throw Error(ErrorKind::Usage,
                    "--filter: '" + filter + "' is not usable; center or box would be right");
    if (paths != "all" && paths != "mirrors")
        throw Error(ErrorKind::Usage,
                    "--paths: '" + paths + "' is not usable; all or mirrors would be right");
    result.paths = paths == "mirrors" ? reference::Paths::Mirrors : reference::Paths::All;
    result.filter = filter == "box" ? reference::PixelFilter::Box : reference::PixelFilter::Center;
    return result;
}

std::string TracerOptions::given() const {
    return firstGiven(command_, {"--spp", "--noise", "--denoise", "--paths", "--filter", "--seed"});
}

void RadiosityOptions::addTo(CLI::App& command) {
    command_ = &command;
    addSolverTo(command);
    command.add_flag("--specular", specular,
                     "mode radiosity: reflections on top, by the path tracer (takes --spp and --noise)");
    command
        .add_option("--bake", bakeFile,
                    "mode radiosity: save the lit scene as .glb, which every mode and other programs show")
        ->type_name("FILE");
}

void RadiosityOptions::addSolverTo(CLI::App& command) {
    command
        .add_option("--patch", values.patchSize,
                    "modes radiosity and hybrid: longest edge of the patches that exchange light, m "
                    "(default: a 16th of "
                    "the scene)")
        ->type_name("M")
        ->check(CLI::PositiveNumber);
    command
        .add_option("--subdivide", values.maxSubdivision,
                    "modes radiosity and hybrid: further halvings where the light changes fast")
        ->capture_default_str()
        ->type_name("N")
        ->check(CLI::Range(0, 8));
    command
        .add_option(
            "--residual", values.residual,
            "modes radiosity and hybrid: stop when an iteration changes the light by less than this part")
        ->capture_default_str()
        ->type_name("X")
        ->check(CLI::Range(1e-6, 1.0));
    command
        .add_option("--gather-rays", values.gatherRays,
                    "modes radiosity and hybrid: per vertex, for the last bounce")
        ->capture_default_str()
        ->type_name("N")
        ->check(CLI::Range(16, 65536));
    command
        .add_option("--visibility-rays", values.visibilityRays,
                    "modes radiosity and hybrid: per vertex and area light in its penumbra")
        ->capture_default_str()
        ->type_name("N")
        ->check(CLI::Range(16, 4096));
}

std::string RadiosityOptions::givenSolver() const {
    return firstGiven(command_,
                      {"--patch", "--subdivide", "--residual", "--gather-rays", "--visibility-rays"});
}

std::string RadiosityOptions::given() const { return firstGiven(command_, {"--specular", "--bake"}); }

int parseBounces(const std::string& text, int most) {
    if (text == "all") return -1;
    char* end = nullptr;
    const long count = std::strtol(text.c_str(), &end, 10);
    if (text.empty() || *end != '\0' || count < 0 || count > most)
        throw Error(
            ErrorKind::Usage,
            fmt::format("--bounces: '{}' is not usable; a whole number from 0 to {}, or all, would be right",
                        text, most));
    return static_cast<int>(count);
}

void applyBounces(Settings& settings, const std::string& bounces) {
    if (bounces.empty()) return;
    if (settings.mode == Mode::Traced) {
        constexpr int kMost = 15;  // of traced.bounces
        const int count = parseBounces(bounces, kMost);
        settings.traced.bounces = count < 0 ? std::nullopt : std::optional<int>(count);
        if (count == 0 && settings.component == Component::Full) settings.component = Component::Direct;
        return;
    }
    constexpr int kAll = 8;  // what is left after 8 more bounces is below 1 % even at albedo 0.55
    const int count = parseBounces(bounces, kAll);
    settings.cones.bounces = count < 0 ? kAll : count;
    if (count == 0 && settings.component == Component::Full) settings.component = Component::Direct;
}

}  // namespace conelight::program
