// SPDX-License-Identifier: MIT
#include "viewer/picture_job.h"

#include <fmt/core.h>

#include "conelight/error.h"
#include "picture_file.h"

namespace conelight::program {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kSlice{80};  // of work between two frames of the window; by eye

double secondsSince(Clock::time_point then) {
    return std::chrono::duration<double>(Clock::now() - then).count();
}

}  // namespace

void PictureJob::start(const Request& request, const Session& session, const glm::ivec2& size) {
    const bool film = request.kind == RequestKind::Record;
    if (size.x < 2 || size.y < 2) throw Error(ErrorKind::Runtime, request.file + ": there is no picture yet");
    if (film && (request.turntable || request.alongPath) && !isSettingsMode(session.shownMode()))
        throw Error(ErrorKind::Usage, "record: mode " + session.shownMode() +
                                          " needs its time for every frame; `conelight render --mode " +
                                          session.shownMode() + " --path FILE` would be right");
    size_ = film ? size / 2 * 2 : size;  // video codecs want even sizes
    video_ = film ? std::make_unique<VideoFile>(request.file, size_.x, size_.y) : nullptr;
    request_ = request;
    if (!film) request_->count = 1;
    camera_ = session.camera();
    done_ = 0;
    placed_ = stopped_ = false;
    began_ = Clock::now();
}

double PictureJob::secondsLeft() const {
    return done_ == 0 ? -1 : secondsSince(began_) / done_ * (request_->count - done_);
}

void PictureJob::end(Session& session) {
    if (request_->turntable || request_->alongPath) session.moveCamera(camera_);
    request_.reset();
    video_.reset();
}

// The picture of the slot is finished.
void PictureJob::add(Session& session, PictureSlot& slot) {
    if (const std::optional<std::string> error = slot.takeError()) throw Error(ErrorKind::Runtime, *error);
    const Image& linear = slot.linear();
    if (linear.pixels.empty() || !slot.ownPicture())
        throw Error(ErrorKind::Runtime, "there is no picture yet (" + slot.label() +
                                            "); a moment later would be right, after `settle` for example");
    const ImageSettings look = session.shownSettings().image;
    if (video_)
        video_->add(linear, look);
    else
        writePicture(request_->file, linear, look);
    ++done_;
    placed_ = false;
    if (video_ && done_ == request_->count) video_->finish();
}

std::optional<std::string> PictureJob::step(Session& session, PictureSlot& slot) {
    const Clock::time_point start = Clock::now();
    try {
        while (done_ < request_->count) {
            if (stopped_)
                throw Error(ErrorKind::Runtime,
                            fmt::format("record: stopped at frame {} of {}; {}", done_, request_->count,
                                        request_->file + " is not finished"));
            if (!std::exchange(placed_, true)) {
                if (request_->turntable) session.moveCamera(turntableFrame(camera_, done_, request_->count));
                if (request_->alongPath)
                    session.moveCamera(session.cameraPath().frame(done_, request_->count));
            }
            // A mode that settles over frames is drawn until it has: what is written is finished.
            if (!slot.draw(session, session.shownMode(), size_.x, size_.y, {})) add(session, slot);
            if (Clock::now() - start > kSlice) break;
        }
    } catch (...) {
        end(session);
        throw;
    }
    if (done_ < request_->count) return std::nullopt;
    const std::string line = video_ ? fmt::format("written {} ({} frames)", request_->file, done_)
                                    : fmt::format("written {} ({} x {})", request_->file, size_.x, size_.y);
    end(session);
    return line;
}

}  // namespace conelight::program
