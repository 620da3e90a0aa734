// SPDX-License-Identifier: MIT
// `conelight view`: the window round a session. Reads top to bottom: events, commands, requests, pictures,
// GUI, swap; sleeps when nothing changes.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "conelight/renderer.h"
#include "reference/radiosity.h"
#include "session/session.h"

namespace conelight::program {

struct ViewerOptions {
    int width = 0, height = 0;  // of the window, screen units; 0: as it was last, else 1280 x 800
    RendererOptions renderer;
    std::vector<std::string> commands;  // run first, one line each
    bool readStdin = true;
    bool keepState = true;                   // remember what the user does (session/state_files.h)
    bool timing = false;                     // print start and cost of frames
    float uiScale = 0;                       // of text and widgets; 0: the screen's
    int filmSamples = 0;                     // a pixel and frame of films in mode reference; 0: as `render`
    reference::RadiositySettings radiosity;  // of mode radiosity and `bake`
    double startedMs = 0;                    // steady clock when the program started
    std::string scene;                       // its name, shown while it is opened
    // Reads it, in a thread of its own while the window is there; throws and tells as io::loadScene.
    std::function<Session(const io::LoadOptions& watched)> open;
};

// Runs until the window closes or `quit`; returns the exit status. Throws what opening a window and the scene
// throw.
int runViewer(const ViewerOptions& options);

}  // namespace conelight::program
