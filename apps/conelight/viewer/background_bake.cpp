// SPDX-License-Identifier: MIT
#include "viewer/background_bake.h"

#include <mutex>
#include <optional>
#include <utility>

#include "reference/radiosity.h"
#include "viewer/background_job.h"

namespace conelight::program {
namespace {

// Which scene, and how often it had changed.
struct Version {
    std::uint64_t scene = 0, tables = 0;
    bool operator==(const Version&) const = default;
};
Version versionOf(const Session& session) {
    return {session.revisions().scene, session.revisions().sceneTables()};
}

}  // namespace

struct BackgroundBake::Impl {
    std::optional<Version> wanted;
    reference::RadiositySettings settings;

    mutable std::mutex mutex;  // guards what follows
    std::shared_ptr<const Scene> lit;
    Version litVersion;
    BakeStatus status;

    BackgroundJob job;  // last: it ends before what it works on does

    void run(const Scene& scene, const Version& version, const reference::RadiositySettings& full,
             const Cancelled& cancelled, void (*wake)());
};

// What `render --mode radiosity` bakes.
void BackgroundBake::Impl::run(const Scene& scene, const Version& version,
                               const reference::RadiositySettings& full, const Cancelled& cancelled,
                               void (*wake)()) {
    bakeTwice({cancelled, mutex, status, wake}, full,
              [&](const reference::RadiositySettings& chosen, const BakeReport& report) {
                  auto baked =
                      std::make_shared<const Scene>(reference::bakeRadiosity(scene, chosen, nullptr, report));
                  return [&, baked] {
                      lit = baked;
                      litVersion = version;
                  };
              });
}

BackgroundBake::BackgroundBake() : impl_(std::make_unique<Impl>()) {}
BackgroundBake::~BackgroundBake() { stop(); }

void BackgroundBake::setSettings(const reference::RadiositySettings& settings) { impl_->settings = settings; }

void BackgroundBake::stop() {
    impl_->job.cancel();
    impl_->wanted.reset();
    const std::lock_guard lock(impl_->mutex);
    impl_->lit.reset();
    impl_->status = {};
}

void BackgroundBake::bake(const Session& session, void (*wake)()) {
    const Version version = versionOf(session);
    if (impl_->wanted == version) return;
    impl_->job.cancel();
    if (impl_->job.busy()) return;  // its end wakes the window, which asks again
    impl_->wanted = version;
    {
        const std::lock_guard lock(impl_->mutex);
        impl_->status = {};
        impl_->status.running = true;
    }
    impl_->job.start(
        [impl = impl_.get(), version, scene = std::make_shared<const Scene>(session.scene()),
         settings = impl_->settings,
         wake](const Cancelled& cancelled) { impl->run(*scene, version, settings, cancelled, wake); },
        wake);
}

std::shared_ptr<const Scene> BackgroundBake::lit(const Session& session) const {
    const std::lock_guard lock(impl_->mutex);
    return impl_->litVersion.scene == session.revisions().scene ? impl_->lit : nullptr;
}

bool BackgroundBake::current(const Session& session) const {
    const std::lock_guard lock(impl_->mutex);
    return impl_->lit && impl_->litVersion == versionOf(session);
}

BakeStatus BackgroundBake::status() const {
    const std::lock_guard lock(impl_->mutex);
    return impl_->status;
}

}  // namespace conelight::program
