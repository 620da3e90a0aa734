// SPDX-License-Identifier: MIT
#include "viewer/picture_job.h"

#include <fmt/core.h>

#include "conelight/error.h"
#include "platform/window.h"
#include "provenance.h"
#include "script_run.h"

namespace conelight::program {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kSlice{80};  // of work between two frames of the window; by eye

double secondsSince(Clock::time_point then) {
    return std::chrono::duration<double>(Clock::now() - then).count();
}

}  // namespace

void PictureJob::start(const Request& request, const Session& session, const glm::ivec2& size,
                       const reference::PathTracerSettings& traced) {
    const bool film = request.kind == RequestKind::Record;
    if (size.x < 2 || size.y < 2) throw Error(ErrorKind::Runtime, request.file + ": there is no picture yet");
    const bool sized = request.format.width > 0;
    size_ = sized  ? glm::ivec2(request.format.width, request.format.height)
            : film ? size / 2 * 2  // video codecs want even sizes
                   : size;
    // What is on the screen is written as it is; anything else is drawn to its end.
    whole_ = film || (sized && size_ != size);
    video_ = film ? std::make_unique<VideoFile>(request.file, size_.x, size_.y, request.framesPerSecond, 0,
                                                request.format)
                  : nullptr;
    request_ = request;
    pose_ = session.clipState();
    if (!film) request_->count = 1;
    camera_ = session.camera();
    done_ = 0;
    traced_ = traced;
    placed_ = stopped_ = tracing_ = false;
    waits_ = WaitsFor::Nothing;
    began_ = Clock::now();
}

double PictureJob::part() const { return (done_ + (tracing_ ? frame_.done() : 0)) / request_->count; }

double PictureJob::secondsLeft() const {
    constexpr double kEnough = 0.01;  // of the work, to judge the rest by
    const double part = this->part();
    return done_ == 0 && part < kEnough ? -1 : secondsSince(began_) / part * (1 - part);
}

void PictureJob::end(Session& session) {
    if (request_->clip && session.clipsFit())
        pose_.posed ? session.poseClip(pose_.clip, pose_.seconds) : session.restClip();
    if (request_->turntable || request_->alongPath || request_->clip) session.moveCamera(camera_);
    frame_.stop();
    waits_ = WaitsFor::Nothing;
    request_.reset();
    video_.reset();
}

// The next picture, or a part of its work: what a mode needs until it is finished. Returns whether it is.
bool PictureJob::draw(Session& session, PictureSlot& slot) {
    const std::string mode = session.shownMode();
    waits_ = WaitsFor::Nothing;
    if (whole_ && mode == "reference") {
        slot.restInBackground();
        if (!tracing_) tracing_ = frame_.start(session, size_, traced_, platform::Window::wake);
        if (!tracing_ || !frame_.ready()) {
            waits_ = WaitsFor::PathTracer;
            return false;
        }
        tracing_ = false;
        Image picture = frame_.take();
        add(session, picture);
        slot.show(session, std::move(picture));
        return true;
    }
    // A mode that settles over frames is drawn until it has: what is written is finished.
    if (slot.draw(session, mode, size_.x, size_.y, {})) return false;
    const bool bakes = mode == "radiosity" || mode == "hybrid";
    if (whole_ && (bakes || mode == "beams") && !slot.finished()) {
        waits_ = bakes ? WaitsFor::Bake : WaitsFor::PathTracer;
        // Pictures are quick: the bake does not count for what is left.
        if (done_ == 0) began_ = Clock::now();
        return false;
    }
    add(session, finished(slot));
    return true;
}

Image PictureJob::finished(PictureSlot& slot) {
    if (const std::optional<std::string> error = slot.takeError()) throw Error(ErrorKind::Runtime, *error);
    const Image& linear = slot.linear();
    if (linear.pixels.empty() || !slot.ownPicture())
        throw Error(ErrorKind::Runtime, "there is no picture yet (" + slot.label() +
                                            "); a moment later would be right, after `settle` for example");
    return linear;
}

void PictureJob::add(const Session& session, const Image& linear) {
    const WrittenPicture picture = pictureFor(request_->format, linear, session.scene(), session.camera(),
                                              session.shownSettings().image);
    PictureRequest drawn = requestFor(session, {});
    drawn.size = {linear.width, linear.height};
    drawn.reference.samplesPerPixel = 0;  // as many as there were
    const PictureTexts texts = provenanceOf(drawn, session.path(), {});
    if (video_)
        video_->add(picture.image, picture.look, texts);
    else
        writePicture(request_->file, picture.image, picture.look, texts, {}, request_->format);
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
                if (request_->clip) session.poseClip(pose_.clip, double(done_) / request_->framesPerSecond);
            }
            if (!draw(session, slot) && waits()) break;
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
