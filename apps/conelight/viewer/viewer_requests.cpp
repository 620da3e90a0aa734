// SPDX-License-Identifier: MIT
#include "viewer/viewer_requests.h"

#include <fmt/core.h>

#include <filesystem>

#include "conelight/error.h"
#include "inspection_text.h"

namespace conelight::program {
namespace {

constexpr int kMaxScreenshots = 9999;

void inspect(PictureView& view, Console& console, const Request& request) {
    Renderer* renderer = view.slot(false).renderer();
    if (renderer == nullptr)
        throw Error(ErrorKind::Usage,
                    "inspect: this mode keeps no cones or rays; traced, cones or thesis "
                    "would be right");
    for (const std::string& line :
         inspectionText(renderer->inspectPixel(request.x, request.y), request.steps))
        console.print(line);
}

void carryOut(Session& session, PictureView& view, Console& console, ViewerState& state,
              const Request& request, const std::function<void(const Request&)>& window) {
    switch (request.kind) {
        case RequestKind::Screenshot:
        case RequestKind::Record:
            state.job.start(request, session, view.fullSize(), state.traced);
            break;
        case RequestKind::Bake:
            state.bake = request;
            break;
        case RequestKind::Load:
            for (const std::string& note : session.open(request.file, request.keepView)) console.print(note);
            console.print("loaded " + request.file);
            break;
        case RequestKind::Window:
            window(request);
            break;
        case RequestKind::Quit:
            state.quit = true;
            state.status = request.status;
            break;
        case RequestKind::Inspect:
            inspect(view, console, request);
            state.inspect = glm::ivec2(request.x, request.y);
            break;
        case RequestKind::SingleFrame:
            view.slot(false).redraw();
            break;
        case RequestKind::Revoxelize:  // the session's counters make the next frame do it
        case RequestKind::Wait:
            break;
    }
}

}  // namespace

std::string nextScreenshot() {
    for (int i = 1; i < kMaxScreenshots; ++i) {
        const std::string name = fmt::format("conelight-{:04}.png", i);
        std::error_code ignored;
        if (!std::filesystem::exists(name, ignored)) return name;
    }
    return "conelight.png";
}

bool carryOutRequest(Session& session, PictureView& view, Console& console, ViewerState& state,
                     const std::function<void(const Request&)>& window) {
    if (state.job.busy()) return false;  // what comes behind it waits
    const std::optional<Request> request = session.takeRequest();
    if (!request) return false;
    try {
        carryOut(session, view, console, state, *request, window);
    } catch (const Error& error) {
        console.fail(error);
    }
    return true;
}

}  // namespace conelight::program
