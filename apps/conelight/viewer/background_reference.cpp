// SPDX-License-Identifier: MIT
#include "viewer/background_reference.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <mutex>
#include <optional>
#include <utility>

#include "reference/path_tracer.h"
#include "traced_picture.h"
#include "viewer/background_job.h"

namespace conelight::program {
namespace {

// A scene as it was when the work on it began, with the rays' structure; shared by pictures of it.
struct TracedScene {
    std::uint64_t tables = 0;
    Scene scene;
    std::optional<reference::PathTracer> tracer;
};

// What a refinement is for.
struct Wanted {
    std::uint64_t tables = 0;
    Camera camera;
    int width = 0, height = 0;
    int samplesPerPixel = 0;
    Component component = Component::Full;
    bool emissiveQuads = true, smallLamps = true;

    bool samePicture(const Wanted& other) const {
        return sameView(other) && width == other.width && height == other.height &&
               samplesPerPixel == other.samplesPerPixel;
    }
    bool sameView(const Wanted& other) const {
        return tables == other.tables && component == other.component &&
               emissiveQuads == other.emissiveQuads && smallLamps == other.smallLamps &&
               camera.eye == other.camera.eye && camera.target == other.camera.target &&
               camera.up == other.camera.up && camera.fovY == other.camera.fovY &&
               camera.zNear == other.camera.zNear && camera.lensDiameter == other.camera.lensDiameter &&
               camera.focusDistance == other.camera.focusDistance &&
               camera.orthographicHeight == other.camera.orthographicHeight;
    }
};

Wanted wantedOf(const Session& session) {
    Wanted wanted;
    wanted.tables = session.revisions().sceneTables();
    wanted.camera = session.camera();
    wanted.component = session.settings().component;
    wanted.emissiveQuads = session.settings().light.emissiveQuads;
    wanted.smallLamps = session.settings().light.smallLamps;
    return wanted;
}

// Adds a round's picture to the mean of those before it.
void accumulate(Image& mean, int before, const Image& round, int samples) {
    if (before == 0) {
        mean = round;
        return;
    }
    const float weight = static_cast<float>(samples) / static_cast<float>(before + samples);
    for (std::size_t i = 0; i < mean.pixels.size(); ++i)
        mean.pixels[i] = glm::mix(mean.pixels[i], round.pixels[i], weight);
}

}  // namespace

struct BackgroundReference::Impl {
    Method method = Method::Paths;
    std::optional<Wanted> wanted;  // what the thread works on, or has finished
    std::uint64_t jobs = 0;
    std::shared_ptr<TracedScene> scene;

    mutable std::mutex mutex;  // guards what follows
    Image mean;
    std::uint64_t version = 0;
    ReferenceStatus status;

    BackgroundJob job;  // last: it ends before what it works on does

    void run(const Wanted& work, TracedScene& traced, const Cancelled& cancelled, void (*wake)());
    void refinePaths(const Wanted& work, TracedScene& traced, const Cancelled& cancelled, void (*wake)());
    void drawBeams(const Wanted& work, const Scene& scene, const Cancelled& cancelled);
    void clear(bool running);
};

void BackgroundReference::Impl::clear(bool running) {
    const std::lock_guard lock(mutex);
    mean = {};
    status = {};
    status.running = running;
}

void BackgroundReference::Impl::run(const Wanted& work, TracedScene& traced, const Cancelled& cancelled,
                                    void (*wake)()) {
    std::string failure;
    try {
        if (method == Method::Beams)
            drawBeams(work, traced.scene, cancelled);
        else
            refinePaths(work, traced, cancelled, wake);
    } catch (const std::exception& error) {
        failure = error.what();
    }
    if (cancelled) return;
    const std::lock_guard lock(mutex);
    status.error = failure;
    status.running = false;
}

void BackgroundReference::Impl::refinePaths(const Wanted& work, TracedScene& traced,
                                            const Cancelled& cancelled, void (*wake)()) {
    if (!traced.tracer) traced.tracer.emplace(traced.scene);
    imageOf(reference::PathTracedPicture{}, work.component);  // refused before the work
    Image sum;
    int done = 0;
    // Rounds grow, so that there is something to see at once and little is lost to overhead later.
    for (std::uint32_t round = 0; done < work.samplesPerPixel && !cancelled; ++round) {
        reference::PathTracerSettings settings;
        settings.samplesPerPixel = std::clamp(done, 2, 32);
        settings.seed = round + 1;
        settings.emissiveQuads = work.emissiveQuads;
        settings.smallLamps = work.smallLamps;
        settings.threads = BackgroundJob::threads();
        const reference::PathTracedPicture picture =
            traced.tracer->render(work.camera, work.width, work.height, settings,
                                  [&](const reference::PathTracerProgress&) { return !cancelled; });
        if (cancelled || picture.samplesPerPixel == 0) break;
        accumulate(sum, done, imageOf(picture, work.component), picture.samplesPerPixel);
        done += picture.samplesPerPixel;
        {
            const std::lock_guard lock(mutex);
            mean = sum;
            ++version;
            status.samplesPerPixel = done;
            status.noise = picture.noise * std::sqrt(static_cast<double>(picture.samplesPerPixel) / done);
        }
        wake();
    }
}

void BackgroundReference::Impl::drawBeams(const Wanted& work, const Scene& traced,
                                          const Cancelled& cancelled) {
    imageOf(reference::BeamPicture{}, work.component);  // refused before the work
    reference::BeamSettings settings;
    settings.filter = reference::PixelFilter::Box;
    settings.emissiveQuads = work.emissiveQuads;
    settings.threads = BackgroundJob::threads();
    const reference::BeamPicture picture = reference::traceBeams(
        traced, work.camera, work.width, work.height, settings, [&](double) { return !cancelled; });
    if (cancelled || picture.stopped) return;
    const std::lock_guard lock(mutex);
    mean = imageOf(picture, work.component);
    ++version;
    status.samplesPerPixel = 1;
}

BackgroundReference::BackgroundReference(Method method) : impl_(std::make_unique<Impl>()) {
    impl_->method = method;
}
BackgroundReference::~BackgroundReference() { stop(); }

void BackgroundReference::stop() {
    impl_->job.cancel();
    impl_->wanted.reset();
    impl_->clear(false);
}

bool BackgroundReference::shows(const Session& session) const {
    return impl_->wanted && impl_->wanted->sameView(wantedOf(session));
}

void BackgroundReference::refine(const Session& session, int width, int height, int samplesPerPixel,
                                 void (*wake)()) {
    Wanted wanted = wantedOf(session);
    wanted.width = width;
    wanted.height = height;
    wanted.samplesPerPixel = samplesPerPixel;
    if (impl_->wanted && impl_->wanted->samePicture(wanted)) return;
    impl_->job.cancel();
    if (impl_->job.busy()) return;  // its end wakes the window, which asks again
    if (!impl_->scene || impl_->scene->tables != wanted.tables) {
        impl_->scene = std::make_shared<TracedScene>();
        impl_->scene->tables = wanted.tables;
        impl_->scene->scene = session.scene();
    }
    impl_->clear(true);
    impl_->wanted = wanted;
    ++impl_->jobs;
    impl_->job.start([impl = impl_.get(), wanted, scene = impl_->scene,
                      wake](const Cancelled& cancelled) { impl->run(wanted, *scene, cancelled, wake); },
                     wake);
}

std::uint64_t BackgroundReference::jobs() const { return impl_->jobs; }

bool BackgroundReference::take(std::uint64_t& version, Image& picture) {
    const std::lock_guard lock(impl_->mutex);
    if (impl_->version == version || impl_->mean.pixels.empty()) return false;
    version = impl_->version;
    picture = impl_->mean;
    return true;
}

ReferenceStatus BackgroundReference::status() const {
    const std::lock_guard lock(impl_->mutex);
    return impl_->status;
}

}  // namespace conelight::program
