// SPDX-License-Identifier: MIT
#include "viewer/file_bake.h"

#include <mutex>
#include <utility>

#include "interrupt.h"
#include "io/gltf_write.h"
#include "viewer/background_job.h"

namespace conelight::program {

struct FileBake::Impl {
    std::string file;
    bool overwrite = false, started = false, stopped = false;

    mutable std::mutex mutex;  // guards what follows
    BakeStatus status;
    std::optional<Scene> lit;
    std::optional<Error> failure;

    BackgroundJob job;  // last: it ends before what it works on does

    void run(const Scene& scene, const reference::RadiositySettings& settings, const Cancelled& cancelled,
             void (*wake)());
};

void FileBake::Impl::run(const Scene& scene, const reference::RadiositySettings& settings,
                         const Cancelled& cancelled, void (*wake)()) {
    std::optional<Scene> baked;
    std::optional<Error> error;
    try {
        baked =
            reference::bakeRadiosity(scene, settings, nullptr, bakeWatcher({cancelled, mutex, status, wake}));
    } catch (const Error& one) {
        error = one;
    } catch (const std::exception& one) {
        error = Error(ErrorKind::Runtime, std::string("bake: ") + one.what());
    }
    const std::lock_guard lock(mutex);
    status = {};
    lit = std::move(baked);
    failure = error;
}

FileBake::FileBake() : impl_(std::make_unique<Impl>()) {}
FileBake::~FileBake() = default;

void FileBake::start(const std::string& file, bool overwrite, const Scene& scene,
                     const reference::RadiositySettings& settings, void (*wake)()) {
    impl_->file = file;
    impl_->overwrite = overwrite;
    impl_->stopped = false;
    impl_->lit.reset();
    impl_->failure.reset();
    impl_->status.running = true;
    impl_->started =
        impl_->job.start([impl = impl_.get(), copy = std::make_shared<const Scene>(scene), settings,
                          wake](const Cancelled& cancelled) { impl->run(*copy, settings, cancelled, wake); },
                         wake);
}

void FileBake::stop() {
    impl_->stopped = true;
    impl_->job.cancel();
}

bool FileBake::busy() const { return impl_->started; }
const std::string& FileBake::file() const { return impl_->file; }

BakeStatus FileBake::status() const {
    const std::lock_guard lock(impl_->mutex);
    return impl_->status;
}

std::optional<std::vector<std::string>> FileBake::finish() {
    if (!impl_->started || impl_->job.busy()) return std::nullopt;
    impl_->started = false;
    if (impl_->stopped) throw Error(ErrorKind::Runtime, "bake: stopped; " + impl_->file + " is not written");
    if (impl_->failure) throw *impl_->failure;
    const WritingScope writing;
    std::vector<std::string> lines = io::writeGltf(impl_->file, *impl_->lit, impl_->overwrite);
    lines.push_back("written " + impl_->file);
    return lines;
}

}  // namespace conelight::program
