// SPDX-License-Identifier: MIT
// What commands and panels asked for, carried out between frames: scenes to load, pictures to write, pixels
// to inspect, the end.
#pragma once

#include <functional>
#include <string>

#include "session/session.h"
#include "viewer/document.h"
#include "viewer/long_work.h"
#include "viewer/picture_view.h"
#include "viewer/pixel_probe.h"
#include "viewer/viewer_console.h"

namespace conelight::program {

struct RequestInputs {
    Session& session;
    PictureView& view;
    ViewerConsole& console;
    LongWork& work;
    PixelProbe& probe;
    Ending& ending;
    std::function<void(const Request&)> window;  // carries out RequestKind::Window
};

// One request. A failure is that of its command. Returns whether there was one.
bool carryOutRequest(const RequestInputs& inputs);

// "conelight-0001.png" and so on: the first that does not exist yet, in the current folder. Of an ending with a
// pattern: "conelight-%04d.png".
std::string nextName(const std::string& ending);

}  // namespace conelight::program
