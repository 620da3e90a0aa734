// SPDX-License-Identifier: MIT
#include "viewer/viewer_requests.h"

#include <fmt/core.h>

#include <filesystem>

#include "conelight/error.h"
#include "inspection_text.h"
#include "picture_file.h"
#include "video_file.h"

namespace conelight::program {
namespace {

constexpr int kMaxScreenshots = 9999;

// A mode that settles over frames is drawn until it has, so that a picture on disk is the finished one.
const Image& finishedPicture(Session& session, PictureView& view, const glm::ivec2& size) {
    PictureSlot& slot = view.slot(false);
    while (slot.draw(session, session.shownMode(), size.x, size.y, {})) {
    }
    if (const std::optional<std::string> error = slot.takeError()) throw Error(ErrorKind::Runtime, *error);
    const Image& linear = slot.linear();
    if (linear.pixels.empty() || !slot.ownPicture())
        throw Error(ErrorKind::Runtime, "there is no picture yet (" + slot.label() +
                                            "); a moment later would be right, after `settle` for example");
    return linear;
}

void screenshot(Session& session, PictureView& view, Console& console, const std::string& file) {
    const Image& linear = finishedPicture(session, view, view.fullSize());
    writePicture(file, linear, session.shownSettings().image);
    console.print(fmt::format("written {} ({} x {})", file, linear.width, linear.height));
}

// `count` frames while the camera turns once round its target, goes along its path or stands still.
void record(Session& session, PictureView& view, Console& console, const Request& request) {
    const glm::ivec2 size = view.fullSize() / 2 * 2;  // video codecs want even sizes
    if (size.x < 2) throw Error(ErrorKind::Runtime, request.file + ": there is no picture yet");
    VideoFile video(request.file, size.x, size.y);
    const Camera start = session.camera();
    for (int i = 0; i < request.count; ++i) {
        if (request.turntable) session.moveCamera(turntableFrame(start, i, request.count));
        if (request.alongPath) session.moveCamera(session.cameraPath().frame(i, request.count));
        video.add(finishedPicture(session, view, size), session.shownSettings().image);
    }
    session.moveCamera(start);
    video.finish();
    console.print(fmt::format("written {} ({} frames)", request.file, request.count));
}

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
            screenshot(session, view, console, request.file);
            break;
        case RequestKind::Record:
            record(session, view, console, request);
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
