// SPDX-License-Identifier: MIT
// `status`: what the window shows and what that costs, in words.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "platform/window.h"
#include "session/session.h"
#include "viewer/gui.h"
#include "viewer/panel_layout.h"
#include "viewer/picture_view.h"
#include "viewer/pixel_probe.h"
#include "viewer/timings.h"
#include "viewer/viewer_console.h"

namespace conelight::program {

struct StatusInputs {
    const Session& session;
    const platform::Window& window;
    const Gui& gui;
    PictureView& view;
    const ViewerConsole& console;
    const PixelProbe& probe;
    const std::optional<std::string>& hint;
    const PanelLayout& panels;
    const Timings& timings;
};

// Keys, those of commands_window.cpp, and their texts.
std::vector<std::pair<std::string, std::string>> statusLines(const StatusInputs& inputs);

}  // namespace conelight::program
