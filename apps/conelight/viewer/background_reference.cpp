// SPDX-License-Identifier: MIT
#include "viewer/background_reference.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>

#include "reference/path_tracer.h"

namespace conelight::program {
namespace {

// What a running refinement was started for.
struct Job {
    std::uint64_t tables = 0;
    Camera camera;
    int width = 0, height = 0;
    int samplesPerPixel = 0;

    bool samePicture(const Job& other) const {
        return tables == other.tables && width == other.width && height == other.height &&
               samplesPerPixel == other.samplesPerPixel && camera.eye == other.camera.eye &&
               camera.target == other.camera.target && camera.up == other.camera.up &&
               camera.fovY == other.camera.fovY && camera.zNear == other.camera.zNear;
    }
};

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
    std::optional<Job> job;
    std::shared_ptr<const Scene> scene;  // a copy: the session's may change meanwhile
    std::uint64_t sceneTables = 0;
    std::thread thread;
    std::atomic<bool> cancelled{false};

    mutable std::mutex mutex;  // guards what follows
    Image mean;
    std::uint64_t version = 0;
    ReferenceStatus status;

    void run(const Job& work, void (*wake)());
    void publish(const Image& picture, int samples, double noise);
};

void BackgroundReference::Impl::publish(const Image& picture, int samples, double noise) {
    const std::lock_guard lock(mutex);
    mean = picture;
    ++version;
    status.samplesPerPixel = samples;
    status.noise = noise;
}

void BackgroundReference::Impl::run(const Job& work, void (*wake)()) {
    try {
        const reference::PathTracer tracer(*scene);
        Image sum;
        int done = 0;
        // Rounds grow, so that there is something to see at once and little is lost to overhead later.
        for (std::uint32_t round = 0; done < work.samplesPerPixel && !cancelled; ++round) {
            reference::PathTracerSettings settings;
            settings.samplesPerPixel = std::clamp(done, 2, 32);
            settings.seed = round + 1;
            const reference::PathTracedPicture picture =
                tracer.render(work.camera, work.width, work.height, settings,
                              [this](const reference::PathTracerProgress&) { return !cancelled; });
            if (cancelled || picture.samplesPerPixel == 0) break;
            accumulate(sum, done, picture.full, picture.samplesPerPixel);
            done += picture.samplesPerPixel;
            const double share = static_cast<double>(picture.samplesPerPixel) / done;
            publish(sum, done, picture.noise * std::sqrt(share));
            wake();
        }
    } catch (const std::exception& error) {
        const std::lock_guard lock(mutex);
        status.error = error.what();
    }
    const std::lock_guard lock(mutex);
    status.running = false;
}

BackgroundReference::BackgroundReference() : impl_(std::make_unique<Impl>()) {}
BackgroundReference::~BackgroundReference() { stop(); }

void BackgroundReference::stop() {
    impl_->cancelled = true;
    if (impl_->thread.joinable()) impl_->thread.join();
    impl_->cancelled = false;
    impl_->job.reset();
    const std::lock_guard lock(impl_->mutex);
    impl_->status = {};
}

void BackgroundReference::refine(const Session& session, int width, int height, int samplesPerPixel,
                                 void (*wake)()) {
    const Job wanted{session.revisions().sceneTables(), session.camera(), width, height, samplesPerPixel};
    if (impl_->job && impl_->job->samePicture(wanted)) return;
    stop();
    if (!impl_->scene || impl_->sceneTables != wanted.tables) {
        impl_->scene = std::make_shared<const Scene>(session.scene());
        impl_->sceneTables = wanted.tables;
    }
    impl_->job = wanted;
    impl_->status.running = true;
    impl_->thread = std::thread([this, wanted, wake] { impl_->run(wanted, wake); });
}

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
