// SPDX-License-Identifier: MIT
// Options of the modes that run on the CPU: `reference` (path tracer) and `radiosity`; and --bounces, which
// means the same in every mode.
#pragma once

#include <CLI/CLI.hpp>

#include <string>

#include "conelight/settings.h"
#include "reference/denoise.h"
#include "reference/path_tracer.h"
#include "reference/radiosity.h"

namespace conelight::program {

// Views of a picture through a box filter: edges in so many steps, as many passes as `traced` averages.
constexpr int kStillViews = 16;

struct TracerOptions {
    int samples = 0;  // 0: not given
    std::string noise;
    std::uint32_t seed = 1;
    std::string filter = "center";
    std::string paths = "all";
    std::string denoiser;

    // `filterHelp`: what --filter does there.
    void addTo(CLI::App& command, const std::string& filterHelp);
    // --denoise; of commands whose picture is no truth.
    void addDenoiseTo(CLI::App& command);
    // Throws Error(Usage), also for one that is not built in.
    reference::Denoiser denoises() const;
    bool filterGiven() const { return command_ != nullptr && command_->count("--filter") > 0; }
    // The settings asked for; throws Error(Usage). Without --spp: 256, or with --noise as many as it takes.
    reference::PathTracerSettings settings() const;
    // The first option that was given, as on the command line; empty: none.
    std::string given() const;

  private:
    CLI::App* command_ = nullptr;
};

struct RadiosityOptions {
    reference::RadiositySettings values;
    bool specular = false;
    std::string bakeFile;

    void addTo(CLI::App& command);
    void addSolverTo(CLI::App& command);  // `values` alone
    std::string givenSolver() const;      // the first option of addSolverTo that was given; empty: none
    std::string given() const;            // the first of the others

  private:
    CLI::App* command_ = nullptr;
};

// "1%" or "0.01" -> 0.01. Throws Error(Usage) that starts with `option`.
double parseFraction(const std::string& option, const std::string& text);

// --bounces: -1 for "all", else the number, 0..`most`. Throws Error(Usage).
int parseBounces(const std::string& text, int most);
// Into the settings of the GL modes, which bounce 0 to 8 times. No text: nothing.
void applyBounces(Settings& settings, const std::string& bounces);

}  // namespace conelight::program
