// SPDX-License-Identifier: MIT
#include "viewer/requests.h"

#include <fmt/core.h>

#include <filesystem>

#include "conelight/error.h"
#include "inspection_text.h"

namespace conelight::program {
namespace {

constexpr int kMaxScreenshots = 9999;

void inspect(const RequestInputs& in, const Request& request) {
    PictureSlot& slot = in.view.slot(false);
    if (!slot.inspects())
        throw Error(ErrorKind::Usage,
                    "inspect: this mode keeps no cones or rays; traced, cones or thesis "
                    "would be right");
    for (const std::string& line : inspectionText(slot.inspectPixel({request.x, request.y}), request.steps))
        in.console.say(line);
    in.probe.inspectPixel({request.x, request.y});  // as if it were clicked
}

void carryOut(const RequestInputs& in, const Request& request) {
    switch (request.kind) {
        case RequestKind::Screenshot:
        case RequestKind::Record:
            in.work.startPictures(request);
            break;
        case RequestKind::Bake:
            in.work.startBake(request);
            break;
        case RequestKind::Load:
            in.work.startLoad(request);
            break;
        case RequestKind::Import:
            in.work.startImport(request);
            break;
        case RequestKind::Window:
            in.window(request);
            break;
        case RequestKind::Quit:
            in.ending = {true, request.status};
            break;
        case RequestKind::Inspect:
            inspect(in, request);
            break;
        case RequestKind::SingleFrame:
            in.view.slot(false).redraw();
            break;
        case RequestKind::Revoxelize:  // the session's counters make the next frame do it
        case RequestKind::Wait:
            break;
    }
}

}  // namespace

std::string nextName(const std::string& ending) {
    if (ending.find('%') != std::string::npos) return "conelight-" + ending;
    for (int i = 1; i < kMaxScreenshots; ++i) {
        const std::string name = fmt::format("conelight-{:04}{}", i, ending);
        std::error_code ignored;
        if (!std::filesystem::exists(name, ignored)) return name;
    }
    return "conelight" + ending;
}

bool carryOutRequest(const RequestInputs& in) {
    if (in.work.holdsRequests()) return false;
    // One scene after the other.
    if (const Request* next = in.session.nextRequest();
        next != nullptr && in.work.loads() &&
        (next->kind == RequestKind::Load || next->kind == RequestKind::Import)) {
        in.work.stopLoading();
        return false;
    }
    const std::optional<Request> request = in.session.takeRequest();
    if (!request) return false;
    try {
        carryOut(in, *request);
    } catch (const Error& error) {
        in.console.commands().fail(error);
    }
    return true;
}

}  // namespace conelight::program
