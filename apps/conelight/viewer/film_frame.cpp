// SPDX-License-Identifier: MIT
#include "viewer/film_frame.h"

#include <atomic>
#include <exception>
#include <optional>
#include <string>
#include <utility>

#include "conelight/error.h"
#include "traced_picture.h"
#include "viewer/background_job.h"

namespace conelight::program {

struct FilmFrame::Impl {
    // As it was when a frame of it began, with the rays' structure.
    struct TracedScene {
        std::uint64_t tables = 0;
        Scene scene;
        std::optional<reference::PathTracer> tracer;
    };
    // Shared with the thread, which may outlive the wish for it.
    struct Work {
        std::atomic<double> done{0};
        Image picture;
        std::string failure;
    };
    std::shared_ptr<TracedScene> scene;
    std::shared_ptr<Work> work;  // null: nothing was started
    BackgroundJob job;
};

FilmFrame::FilmFrame() : impl_(std::make_unique<Impl>()) {}
FilmFrame::~FilmFrame() = default;

bool FilmFrame::start(const Session& session, const glm::ivec2& size,
                      const reference::PathTracerSettings& settings, void (*wake)()) {
    Impl& m = *impl_;
    if (m.job.busy()) return false;
    const std::uint64_t tables = session.revisions().sceneTables();
    if (!m.scene || m.scene->tables != tables) {
        m.scene = std::make_shared<Impl::TracedScene>();
        m.scene->tables = tables;
        m.scene->scene = session.scene();
    }
    reference::PathTracerSettings wanted = settings;
    wanted.emissiveQuads = session.settings().light.emissiveQuads;
    wanted.smallLamps = session.settings().light.smallLamps;
    wanted.threads = BackgroundJob::threads();
    m.work = std::make_shared<Impl::Work>();
    return m.job.start(
        [work = m.work, scene = m.scene, camera = session.camera(), wanted, size,
         component = session.shownSettings().component](const Cancelled& cancelled) {
            try {
                if (!scene->tracer) scene->tracer.emplace(scene->scene);
                imageOf(reference::PathTracedPicture{}, component);  // refused before the work
                const auto onProgress = [&](const reference::PathTracerProgress& now) {
                    work->done = static_cast<double>(now.samplesDone) / std::max(now.samplesPlanned, 1);
                    return !cancelled;
                };
                work->picture =
                    imageOf(scene->tracer->render(camera, size.x, size.y, wanted, onProgress), component);
            } catch (const std::exception& error) {
                work->failure = error.what();
            }
        },
        wake);
}

bool FilmFrame::ready() const { return impl_->work && !impl_->job.busy(); }
double FilmFrame::done() const { return impl_->work ? impl_->work->done.load() : 0; }

Image FilmFrame::take() {
    const std::shared_ptr<Impl::Work> work = std::exchange(impl_->work, nullptr);
    if (!work) throw Error(ErrorKind::Runtime, "no frame was begun");
    if (!work->failure.empty()) throw Error(ErrorKind::Runtime, work->failure);
    return std::move(work->picture);
}

void FilmFrame::stop() {
    impl_->job.cancel();
    impl_->work = nullptr;
}

}  // namespace conelight::program
