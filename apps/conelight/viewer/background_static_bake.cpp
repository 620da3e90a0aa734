// SPDX-License-Identifier: MIT
#include "viewer/background_static_bake.h"

#include <mutex>
#include <string>
#include <utility>

#include "static_bake.h"
#include "viewer/background_job.h"

namespace conelight::program {

struct BackgroundStaticBake::Impl {
    std::string wanted;                           // staticKey of the bake that runs or is done
    std::uint64_t seenScene = 0, seenTables = 0;  // of the session when `wanted` was found
    bool seenQuads = true, seen = false;
    reference::RadiositySettings settings;

    mutable std::mutex mutex;  // guards what follows
    std::shared_ptr<const BakedLight> light;
    std::uint64_t lightScene = 0;
    BakeStatus status;

    BackgroundJob job;  // last: it ends before what it works on does

    bool sees(const Session& session);
    void run(const Scene& scene, std::uint64_t number, const reference::RadiositySettings& full,
             const Cancelled& cancelled, void (*wake)());
};

// Whether nothing at all changed since the last look.
bool BackgroundStaticBake::Impl::sees(const Session& session) {
    const Revisions& now = session.revisions();
    const bool quads = session.settings().light.emissiveQuads;
    const bool same = seen && seenScene == now.scene && seenTables == now.sceneTables() && seenQuads == quads;
    seen = true;
    seenScene = now.scene;
    seenTables = now.sceneTables();
    seenQuads = quads;
    return same;
}

void BackgroundStaticBake::Impl::run(const Scene& scene, std::uint64_t number,
                                     const reference::RadiositySettings& full, const Cancelled& cancelled,
                                     void (*wake)()) {
    bakeTwice({cancelled, mutex, status, wake}, full,
              [&](const reference::RadiositySettings& chosen, const BakeReport& report) {
                  auto baked = std::make_shared<const BakedLight>(
                      reference::bakeIndirect(scene, chosen, nullptr, report));
                  return [&, baked] {
                      light = baked;
                      lightScene = number;
                  };
              });
}

BackgroundStaticBake::BackgroundStaticBake() : impl_(std::make_unique<Impl>()) {}
BackgroundStaticBake::~BackgroundStaticBake() { stop(); }

void BackgroundStaticBake::setSettings(const reference::RadiositySettings& settings) {
    impl_->settings = settings;
}

void BackgroundStaticBake::stop() {
    impl_->job.cancel();
    impl_->wanted.clear();
    impl_->seen = false;
    const std::lock_guard lock(impl_->mutex);
    impl_->light.reset();
    impl_->status = {};
}

void BackgroundStaticBake::bake(const Session& session, void (*wake)()) {
    if (impl_->sees(session)) return;
    reference::RadiositySettings settings = impl_->settings;
    settings.emissiveQuads = session.settings().light.emissiveQuads;
    const std::string key = staticKey(session.scene(), settings);
    if (impl_->wanted == key) return;
    impl_->job.cancel();
    if (impl_->job.busy()) {  // its end wakes the window, which asks again
        impl_->seen = false;
        return;
    }
    impl_->wanted = key;
    {
        const std::lock_guard lock(impl_->mutex);
        impl_->status = {};
        impl_->status.running = true;
    }
    impl_->job.start(
        [impl = impl_.get(), number = session.revisions().scene,
         scene = std::make_shared<const Scene>(session.scene()), settings,
         wake](const Cancelled& cancelled) { impl->run(*scene, number, settings, cancelled, wake); },
        wake);
}

std::shared_ptr<const BakedLight> BackgroundStaticBake::light(const Session& session) const {
    const std::lock_guard lock(impl_->mutex);
    return impl_->lightScene == session.revisions().scene ? impl_->light : nullptr;
}

BakeStatus BackgroundStaticBake::status() const {
    const std::lock_guard lock(impl_->mutex);
    return impl_->status;
}

}  // namespace conelight::program
