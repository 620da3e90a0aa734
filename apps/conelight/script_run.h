// SPDX-License-Identifier: MIT
// Console commands without a window: --exec and --script of `render` and `bench`. The same queue, the same
// commands and the same order as in the viewer; requests are carried out by drawing pictures.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

#include <optional>
#include <string>
#include <vector>

#include "picture_file.h"
#include "picture_source.h"
#include "session/session.h"

namespace conelight::program {

struct ScriptOptions {
    std::vector<std::string> commands;                     // --exec
    std::vector<std::string> files;                        // --script
    std::function<void(Session&, int frame)> beforeFrame;  // of each film, for what moves beside the camera
    // Of the film behind the commands, if any: its frames are drawn with all components of `base`.
    std::function<PictureLayers(const Picture&)> layers;
    bool given() const { return !commands.empty() || !files.empty(); }
    void addTo(CLI::App& command);
};

// Thrown by runScript when a command said `quit`: main() ends with this status.
struct QuitRequest {
    int status = 0;
};

// Runs all scripts, then all commands. `base`: size and what else the pictures of `screenshot`, `record` and
// `wait` are drawn with; mode, settings and camera are the session's. Without `source` commands that need a
// picture are an error. Throws the first error, with the command's place.
// `then`: carried out behind them.
void runScript(const ScriptOptions& options, Session& session, PictureSource* source,
               const PictureRequest& base, Progress& progress, const std::optional<Request>& then = {});

// What the session shows, as a request.
PictureRequest requestFor(const Session& session, const PictureRequest& base);

}  // namespace conelight::program
