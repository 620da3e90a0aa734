// SPDX-License-Identifier: MIT
#include "viewer/picture_slot.h"

#include <chrono>
#include <optional>

#include "platform/picture_texture.h"
#include "platform/window.h"

namespace conelight::program {
namespace {

// A mode that gathers light over frames is drawn this often after a change before the window rests: means run
// over 16 frames, after some in which light settles.
constexpr int kSettlingFrames = 24;
// The background reference rests here: below 1 % noise in closed rooms.
constexpr int kReferenceSamples = 4096;

bool settlesOverFrames(const std::string& mode) { return mode == "traced"; }

// What the picture depends on; selection and the list of cameras are not part of it.
struct PictureKey {
    std::uint64_t tables = 0, settings = 0, camera = 0, flags = 0;
    bool operator==(const PictureKey&) const = default;
};
PictureKey keyOf(const Revisions& r) { return {r.sceneTables(), r.settings, r.camera, r.flags}; }

double wallMs() {
    using clock = std::chrono::steady_clock;
    return std::chrono::duration<double, std::milli>(clock::now().time_since_epoch()).count();
}

}  // namespace

struct PictureSlot::Impl {
    std::string shaderDirectory;
    bool debugGl;
    std::unique_ptr<Renderer> renderer;
    std::uint64_t uploaded = 0;
    bool hasScene = false;

    // What the last picture shows.
    std::string mode;
    std::optional<PictureKey> shown;
    int width = 0, height = 0;
    int settling = 0;
    double frameMs = 0;
    std::uint64_t version = 0;
    std::uint32_t texture = 0;

    std::optional<Image> linear;
    BackgroundReference reference;
    std::uint64_t referenceVersion = 0;
    platform::PictureTexture referenceTexture;
    ImageSettings referenceLook;

    bool drawGl(const Session& session, int w, int h);
    bool drawReference(const Session& session, int w, int h, bool full);
};

PictureSlot::PictureSlot(std::string shaderDirectory, bool debugGl) : impl_(std::make_unique<Impl>()) {
    impl_->shaderDirectory = std::move(shaderDirectory);
    impl_->debugGl = debugGl;
}
PictureSlot::~PictureSlot() = default;

void PictureSlot::redraw() { impl_->shown.reset(); }

void PictureSlot::clear() {
    impl_->reference.stop();
    impl_->renderer.reset();
    impl_->hasScene = false;
    impl_->shown.reset();
    impl_->texture = 0;
    impl_->linear.reset();
}

bool PictureSlot::draw(const Session& session, const std::string& mode, int width, int height, bool full) {
    if (mode != impl_->mode) {
        impl_->reference.stop();
        impl_->shown.reset();
        impl_->mode = mode;
    }
    return mode == "reference" ? impl_->drawReference(session, width, height, full)
                               : impl_->drawGl(session, width, height);
}

bool PictureSlot::Impl::drawGl(const Session& session, int w, int h) {
    if (!renderer) renderer = std::make_unique<Renderer>(RendererOptions{shaderDirectory, debugGl});
    const bool changed = !shown || !(*shown == keyOf(session.revisions())) || w != width || h != height;
    if (changed) settling = settlesOverFrames(mode) ? kSettlingFrames : 1;
    if (settling == 0) return false;
    if (!hasScene || uploaded != session.revisions().sceneTables()) {
        renderer->setScene(session.scene());
        uploaded = session.revisions().sceneTables();
        hasScene = true;
    }
    const double start = wallMs();
    Settings settings = session.shownSettings();
    conelight::setSetting(settings, "mode", mode);
    settings.traced.budgeted = true;  // the window stays live; the picture settles over frames
    renderer->setProfiling(true, false);
    renderer->render(session.camera(), w, h, settings);
    texture = renderer->displayTexture(settings.image);
    frameMs = wallMs() - start;
    linear.reset();
    shown = keyOf(session.revisions());
    width = w;
    height = h;
    ++version;
    --settling;
    return settling > 0;
}

bool PictureSlot::Impl::drawReference(const Session& session, int w, int h, bool full) {
    // While the camera moves the old picture stays: a new one would not come far.
    if (full) reference.refine(session, w, h, kReferenceSamples, platform::Window::wake);
    Image newest;
    const bool isNew = reference.take(referenceVersion, newest);
    if (isNew) linear = std::move(newest);
    const ImageSettings& look = session.settings().image;
    const bool lookChanged = look.exposure != referenceLook.exposure || look.srgb != referenceLook.srgb ||
                             look.toneMap != referenceLook.toneMap;
    if (linear && (isNew || lookChanged || texture != referenceTexture.name())) {
        referenceTexture.update(linear->width, linear->height, toneMapped(*linear, look));
        referenceLook = look;
        texture = referenceTexture.name();
        width = linear->width;
        height = linear->height;
        ++version;
    }
    shown = keyOf(session.revisions());
    return false;  // the thread wakes the window when there is more
}

std::uint32_t PictureSlot::texture() const { return impl_->texture; }
int PictureSlot::width() const { return impl_->width; }
int PictureSlot::height() const { return impl_->height; }
double PictureSlot::frameMs() const { return impl_->frameMs; }
std::uint64_t PictureSlot::version() const { return impl_->version; }

const Image& PictureSlot::linear() {
    if (!impl_->linear) impl_->linear = impl_->renderer ? impl_->renderer->readImage() : Image{};
    return *impl_->linear;
}

const FrameStats* PictureSlot::stats() const {
    return impl_->mode != "reference" && impl_->renderer ? &impl_->renderer->stats() : nullptr;
}

ReferenceStatus PictureSlot::referenceStatus() const { return impl_->reference.status(); }
Renderer* PictureSlot::renderer() { return impl_->mode == "reference" ? nullptr : impl_->renderer.get(); }

}  // namespace conelight::program
