// SPDX-License-Identifier: MIT
#include "script_run.h"

#include <fmt/core.h>

#include <chrono>
#include <iostream>
#include <iterator>

#include "conelight/error.h"
#include "console/console.h"
#include "inspection_text.h"
#include "io/gltf_write.h"
#include "provenance.h"
#include "session/addition.h"
#include "video_file.h"

namespace conelight::program {
namespace {

// Pictures of another size, until it ends.
class SizeScope {
  public:
    SizeScope(PictureRequest& base, const PictureFormat& format) : base_(base), before_(base.size) {
        if (format.width > 0) base_.size = {format.width, format.height};
    }
    ~SizeScope() { base_.size = before_; }
    SizeScope(const SizeScope&) = delete;
    SizeScope& operator=(const SizeScope&) = delete;

  private:
    PictureRequest& base_;
    Size before_;
};

class Runner {
  public:
    Runner(Session& session, PictureSource* source, const PictureRequest& base, Progress& progress)
        : session_(session),
          source_(source),
          base_(base),
          progress_(progress),
          console_(session, [&](const ConsoleLine& line) {
              if (line.isError) return;  // thrown at the end, with the exit status that goes with it
              progress.finish();
              fmt::print("{}\n", line.text);
          }) {
        console_.setStopOnError(true);
    }

    void run(const ScriptOptions& options, const std::optional<Request>& then) {
        beforeFrame_ = options.beforeFrame;
        layers_ = options.layers;
        for (const std::string& file : options.files) {
            if (file == "-")
                console_.submit({std::istreambuf_iterator<char>(std::cin), {}}, "standard input");
            else
                console_.submit("source " + quoted(file), "--script");
        }
        for (const std::string& commands : options.commands) console_.submit(commands, "--exec");
        bool last = !then;
        while (!console_.idle() || session_.hasRequests() || !last) {
            console_.runQueued();
            if (session_.playing()) session_.finishPlaying();  // nobody looks
            if (!last && console_.idle() && !session_.hasRequests()) {
                if (!console_.firstError()) session_.request(*then);
                last = true;
            }
            while (std::optional<Request> request = session_.takeRequest()) carryOut(*request);
            if (console_.framesToWait() > 0) {
                draw();
                console_.frameDone();
            }
        }
        progress_.finish();
        std::fflush(stdout);
        if (console_.firstError()) throw *console_.firstError();
    }

  private:
    // A request that fails is the failure of its command.
    void carryOut(const Request& request) {
        if (request.kind == RequestKind::Quit) {
            progress_.finish();
            std::fflush(stdout);
            throw QuitRequest{request.status};
        }
        try {
            carryOutWork(request);
        } catch (const Error& error) {
            console_.fail(error);
        }
    }

    void carryOutWork(const Request& request) {
        switch (request.kind) {
            case RequestKind::Load:
                progress_.show("loading " + request.file);
                for (const std::string& note : session_.open(request.file, request.keepView))
                    std::fprintf(stderr, "conelight: %s: %s\n", request.file.c_str(), note.c_str());
                break;
            case RequestKind::Import:
                progress_.show("loading " + request.file);
                for (const std::string& line :
                     addImported(session_, console_.picker(), readPart(request.file, session_.openHow()),
                                 request.file))
                    console_.print(line);
                break;
            case RequestKind::Screenshot: {
                screenshot(request);
                break;
            }
            case RequestKind::Record:
                record(request);
                break;
            case RequestKind::Revoxelize: {
                draw();
                std::size_t bytes = 0;
                for (const MemoryStats& object : stats_.memory) bytes += object.bytes;
                console_.print(fmt::format("Voxelization Complete: {} voxels along the longest axis",
                                           session_.settings().voxels.size));
                console_.print(fmt::format("GL objects (bytes): {}", bytes));
                break;
            }
            case RequestKind::Bake:
                bake(request);
                break;
            case RequestKind::SingleFrame:
                draw();
                break;
            case RequestKind::Inspect: {
                draw();
                const PixelInspection pixel =
                    source_->inspect(requestFor(session_, base_), request.x, request.y);
                for (const std::string& line : inspectionText(pixel, request.steps)) console_.print(line);
                break;
            }
            case RequestKind::Window:
                throw Error(ErrorKind::Usage,
                            request.words.front() + ": there is no window; `conelight view` has one");
            default:
                break;
        }
    }

    // What is written of what was drawn.
    WrittenPicture written(const Request& request, const Image& image) const {
        return pictureFor(request.format, image, session_.scene(), session_.camera(),
                          session_.shownSettings().image);
    }
    void screenshot(const Request& request) {
        const SizeScope size(base_, request.format);
        const WrittenPicture picture = written(request, draw());
        writePicture(request.file, picture.image, picture.look, texts(), {}, request.format);
        console_.print("written " + request.file);
    }

    void record(const Request& request) {
        const SizeScope size(base_, request.format);
        const PictureRequest shown = requestFor(session_, base_);
        VideoFile video(request.file, shown.size.width, shown.size.height, request.framesPerSecond,
                        request.first, request.format);
        const Camera start = session_.camera();
        const auto began = std::chrono::steady_clock::now();
        const int total = request.total > 0 ? request.total : request.count;
        for (int frame = 0; frame < request.count; ++frame) {
            const std::chrono::duration<double> gone = std::chrono::steady_clock::now() - began;
            const double left = frame == 0 ? 0 : gone.count() / frame * (request.count - frame);
            progress_.show(fmt::format("{}: frame {} of {}{}", request.file, frame + 1, request.count,
                                       frame == 0 ? "" : fmt::format(", {:.0f} s left", left)));
            const int index = request.first + frame;
            if (beforeFrame_) beforeFrame_(session_, index);
            if (request.turntable) session_.moveCamera(turntableFrame(start, index, total));
            if (request.alongPath) session_.moveCamera(session_.cameraPath().frame(index, total));
            if (request.clip)
                session_.poseClip(session_.clipState().clip, double(index) / request.framesPerSecond);
            const Picture picture = drawPicture(layers_ != nullptr);
            const WrittenPicture frameToWrite = written(request, picture.images.front());
            video.add(frameToWrite.image, frameToWrite.look, texts(),
                      layers_ ? layers_(picture) : PictureLayers{});
        }
        session_.moveCamera(start);
        video.finish();
        console_.print("written " + request.file);
    }

    void bake(const Request& request) {
        if (source_ == nullptr) throw Error(ErrorKind::Usage, "bake: only `render` bakes");
        source_->follow(session_);
        const Scene& lit = source_->bakedScene(base_.radiosity, &progress_);
        const WritingScope writing;
        for (const std::string& note : io::writeGltf(request.file, lit, request.overwrite))
            console_.print(note);
        console_.print("written " + request.file);
    }

    // Of what was drawn last.
    PictureTexts texts() const {
        PictureRequest request = requestFor(session_, base_);
        request.commands.clear();  // not all of them came before it
        return provenanceOf(request, session_.path(), source_->device());
    }

    Image draw() { return std::move(drawPicture(false).images.front()); }

    // `withAll`: all components of `base`, else the one that is shown.
    Picture drawPicture(bool withAll) {
        if (source_ == nullptr)
            throw Error(ErrorKind::Usage, "this command needs a picture, which only `render` draws");
        PictureRequest request = requestFor(session_, base_);
        if (withAll)
            request.components.insert(request.components.end(), base_.components.begin() + 1,
                                      base_.components.end());
        if (session_.showsNothing()) {
            Image image{request.size.width, request.size.height, {}};
            image.pixels.assign(
                static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height),
                glm::vec4(session_.scene().sky, 0));
            Picture nothing;
            nothing.images.assign(request.components.size(), image);
            return nothing;
        }
        source_->follow(session_);
        const auto start = std::chrono::steady_clock::now();
        Picture picture = source_->draw(request, &progress_);
        const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - start;
        stats_ = picture.stats;
        session_.frameDrawn(taken.count());
        if (picture.stopped) throw InterruptedError();  // half a picture is none of a script
        return picture;
    }

    Session& session_;
    PictureSource* source_;
    PictureRequest base_;
    Progress& progress_;
    Console console_;
    FrameStats stats_;
    std::function<void(Session&, int frame)> beforeFrame_;
    std::function<PictureLayers(const Picture&)> layers_;
};

}  // namespace

void ScriptOptions::addTo(CLI::App& command) {
    command
        .add_option("--exec", this->commands,
                    "console commands to run first, as in `mode phong; pos1`; may be repeated")
        ->type_name("COMMANDS")
        ->allow_extra_args(false);
    command
        .add_option("--script", files, "a file of console commands to run before those; - is standard input")
        ->type_name("FILE")
        ->allow_extra_args(false);
}

PictureRequest requestFor(const Session& session, const PictureRequest& base) {
    PictureRequest request = base;
    request.settings = session.shownSettings();
    request.mode = session.shownMode();
    request.camera = session.camera();
    request.components = {request.settings.component};
    return request;
}

void runScript(const ScriptOptions& options, Session& session, PictureSource* source,
               const PictureRequest& base, Progress& progress, const std::optional<Request>& then) {
    if (options.given() || then) Runner(session, source, base, progress).run(options, then);
}

}  // namespace conelight::program
