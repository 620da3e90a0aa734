// SPDX-License-Identifier: MIT
// What commands and panels asked for, carried out between frames: files to load and write, pictures, video.
#pragma once

#include <functional>
#include <string>

#include "console/console.h"
#include "session/session.h"
#include "viewer/picture_job.h"
#include "viewer/picture_view.h"

namespace conelight::program {

struct ViewerState {
    std::optional<glm::ivec2> inspect;     // a pixel that a command asked for: as if it were clicked
    std::optional<Request> bake;           // to be done in the background
    PictureJob job;                        // pictures to write, a little at each frame
    reference::PathTracerSettings traced;  // of films in mode reference
    bool quit = false;
    int status = 0;
};

// One request; `window` carries out RequestKind::Window. A failure is that of its command. Returns whether
// there was one.
bool carryOutRequest(Session& session, PictureView& view, Console& console, ViewerState& state,
                     const std::function<void(const Request&)>& window);

// "conelight-0001.png" and so on: the first that does not exist yet, in the current folder.
std::string nextScreenshot();

}  // namespace conelight::program
