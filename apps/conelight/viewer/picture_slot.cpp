// SPDX-License-Identifier: MIT
#include "viewer/picture_slot.h"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <utility>

#include "conelight/error.h"
#include "platform/picture_texture.h"
#include "platform/window.h"
#include "scene_upload.h"
#include "traced_picture.h"
#include "viewer/background_bake.h"
#include "viewer/background_reference.h"
#include "viewer/background_static_bake.h"
#include "viewer/face_budget.h"
#include "viewer/picture_noise.h"
#include "viewer/picture_passes.h"

namespace conelight::program {
namespace {

// The background reference rests here: below 1 % noise in closed rooms.
constexpr int kReferenceSamples = 4096;
// Part of a picture's time that updates of the light cache may take while the camera flies: a quarter of the
// time that PictureView aims at.
constexpr double kFlyingUpdateMs = 25;

// What the picture depends on; selection and the list of cameras are not part of it.
struct PictureKey {
    std::uint64_t tables = 0, settings = 0, camera = 0, flags = 0;
    bool operator==(const PictureKey&) const = default;
};
PictureKey keyOf(const Revisions& r) { return {r.sceneTables(), r.settings, r.camera, r.flags}; }

// Whether two settings give the same linear picture: all but exposure, bloom, tone map and encoding.
bool sameButLook(Settings a, const Settings& b) {
    const ImageSettings own = a.image;
    a.image = b.image;
    return a == b && own.antialiasing == b.image.antialiasing && own.temporal == b.image.temporal;
}

std::string hybridLabel(const BakeStatus& status, bool baked) {
    if (!status.error.empty()) return "hybrid: " + status.error;
    if (!status.running) return "hybrid";
    return fmt::format("hybrid: baking, {:.0f} %; until then {}", 100 * status.done,
                       baked ? "light as it was, or a draft of it" : "all light by cones");
}

double wallMs() {
    using clock = std::chrono::steady_clock;
    return std::chrono::duration<double, std::milli>(clock::now().time_since_epoch()).count();
}

}  // namespace

struct PictureSlot::Impl {
    RendererOptions options;
    std::unique_ptr<Renderer> renderer;
    SceneUpload upload;                // of the session's scene
    std::shared_ptr<const Scene> lit;  // the baked scene that the renderer holds instead

    // What the last picture shows.
    std::string mode;
    std::optional<PictureKey> shown;
    Settings shownSettings;
    bool own = false;      // the picture is the mode's and of this view
    bool preview = false;  // it is another mode's while the mode has none
    bool asked = false;    // redraw()
    float headlight = 0;
    int width = 0, height = 0;
    PicturePasses passes;              // of the picture
    int settling = 0;                  // passes to come
    PictureNoise noise;                // of what settles
    double frameMs = 0, updateMs = 0;  // the light cache's part
    FaceBudget flyingFaces{kFlyingUpdateMs};
    bool flyingUpdate = false;  // the last update was of flyingFaces
    double voxelsMadeAt = 0;    // ms; ViewFlags::dynamic
    std::uint64_t version = 0;
    std::uint32_t texture = 0;
    std::optional<Image> linear;
    std::optional<std::string> error;
    std::string lastError;  // said once while it stays

    platform::PictureTexture cpuTexture;
    ImageSettings cpuLook;
    BackgroundReference reference, beams{BackgroundReference::Method::Beams};
    std::uint64_t referenceVersion = 0, linearJob = 0;
    BackgroundBake bake;
    BackgroundStaticBake statics;             // of mode hybrid
    std::shared_ptr<const BakedLight> baked;  // that the last picture shows

    bool draw(const Session& session, int w, int h, const How& how);
    bool drawScene(const Session& session, const std::string& drawnMode, int w, int h, const How& how);
    bool drawTraced(BackgroundReference& traced, const Session& session, int w, int h, const How& how);
    bool drawRadiosity(const Session& session, int w, int h, const How& how);
    void drawNothing(const Session& session, int w, int h);
    void renderFrame(const Session& session, Settings settings, int w, int h);
    void showImage(const ImageSettings& look);
    const Image& read();
    std::shared_ptr<const BakedLight> bakedFor(const Session& session, const std::string& drawnMode,
                                               const How& how);
    std::string progress() const;
    void followUpdateTime();
    void followLook(const Session& session);
    bool onlyLook(const Session& session) const;
    void startAnew();
};

PictureSlot::PictureSlot(RendererOptions options) : impl_(std::make_unique<Impl>()) {
    impl_->options = std::move(options);
}
PictureSlot::~PictureSlot() = default;

void PictureSlot::setRadiosity(const reference::RadiositySettings& settings) {
    impl_->bake.setSettings(settings);
    impl_->statics.setSettings(settings);
}

void PictureSlot::redraw() { impl_->asked = true; }

void PictureSlot::setHeadlight(float irradiance) {
    if (std::exchange(impl_->headlight, irradiance) != irradiance) impl_->asked = true;
}

// Nothing is shown until the next picture: what there was is another mode's.
void PictureSlot::Impl::startAnew() {
    reference.stop();
    beams.stop();
    referenceVersion = 0;
    shown.reset();
    linear.reset();
    texture = 0;
    own = preview = false;
    settling = 0;
}

void PictureSlot::blank() { impl_->startAnew(); }

void PictureSlot::clear() {
    impl_->startAnew();
    impl_->bake.stop();
    impl_->statics.stop();
    impl_->baked.reset();
    impl_->renderer.reset();
    impl_->upload.forget();
    impl_->lit.reset();
}

void PictureSlot::show(const Session& session, Image picture) {
    impl_->linear = std::move(picture);
    impl_->linearJob = 0;
    impl_->showImage(session.settings().image);
    impl_->shown = keyOf(session.revisions());
    impl_->shownSettings = session.settings();
    impl_->own = true;
    impl_->preview = false;
    impl_->settling = 0;
}

void PictureSlot::restInBackground() { impl_->reference.stop(); }

std::vector<std::string> PictureSlot::reloadShaders() {
    if (!impl_->renderer) return {};
    impl_->asked = true;
    return impl_->renderer->reloadShaders();
}

bool PictureSlot::draw(const Session& session, const std::string& mode, int width, int height,
                       const How& how) {
    if (mode != impl_->mode) {
        impl_->startAnew();
        impl_->mode = mode;
    }
    try {
        const bool more = impl_->draw(session, width, height, how);
        if (!how.onlyChanges) impl_->lastError.clear();
        return more;
    } catch (const std::exception& error) {
        // Not tried again before something changes.
        impl_->shown = keyOf(session.revisions());
        impl_->shownSettings = session.settings();
        impl_->width = width;
        impl_->height = height;
        impl_->settling = 0;
        impl_->asked = false;
        if (impl_->lastError != error.what()) impl_->error = error.what();
        impl_->lastError = error.what();
        return false;
    }
}

std::optional<std::string> PictureSlot::takeError() { return std::exchange(impl_->error, std::nullopt); }

bool PictureSlot::Impl::draw(const Session& session, int w, int h, const How& how) {
    const ViewFlags& flags = session.flags();
    if (flags.singleFrame && !asked && shown) return false;
    if (session.showsNothing()) {
        drawNothing(session, w, h);
        return false;
    }
    if (mode == "reference") return drawTraced(reference, session, w, h, how);
    if (mode == "beams") return drawTraced(beams, session, w, h, how);
    if (mode == "radiosity") return drawRadiosity(session, w, h, how);
    own = true;
    return drawScene(session, mode, w, h, how);
}

// The scene as it is, in a mode of the renderer.
bool PictureSlot::Impl::drawScene(const Session& session, const std::string& drawnMode, int w, int h,
                                  const How& how) {
    followLook(session);
    const std::shared_ptr<const BakedLight> newest = bakedFor(session, drawnMode, how);
    const ViewFlags& flags = session.flags();
    const bool voxelsDue = flags.dynamic && wallMs() - voxelsMadeAt > 1e3 * flags.period;
    const bool changed =
        asked || !shown || !(*shown == keyOf(session.revisions())) || voxelsDue || newest != baked;
    const bool resized = w != width || h != height;
    if (changed || (resized && !how.onlyChanges)) {
        passes = passesOf(drawnMode, session.settings(), session.camera());
        settling = passes.all();
    }
    if (settling == 0) return resized && how.onlyChanges;
    if (how.onlyChanges && !changed) return true;

    if (!renderer) {
        renderer = std::make_unique<Renderer>(options);
        upload.forget();
    }
    if (lit) {
        lit.reset();
        upload.forget();
    }
    upload.follow(*renderer, session);
    renderer->setBakedLight(newest);
    baked = newest;
    if (voxelsDue) voxelsMadeAt = wallMs();
    Settings settings = session.shownSettings();
    conelight::setSetting(settings, "mode", drawnMode);
    settings.traced.budgeted = true;  // the window stays live; the picture settles over frames
    const bool views = passes.areViews(settling);
    settings.image.temporal = views || smoothsEdges(drawnMode, settings) ? Toggle::On : Toggle::Off;
    renderer->setLightHeld(views);
    const int faces = flyingFaces.faces();
    flyingUpdate = how.flying && faces > 0;
    if (flyingUpdate && (settings.traced.faceBudget == 0 || settings.traced.faceBudget > faces))
        settings.traced.faceBudget = faces;
    renderer->setDynamic(voxelsDue);
    renderFrame(session, settings, w, h);
    followUpdateTime();
    --settling;
    if (drawnMode == "traced" && !views)
        noise.follow(passes.all() - settling, [this]() -> const Image& { return read(); });
    return settling > 0;
}

// Of mode hybrid, as far as it is baked; without it the mode shows all light by cones.
std::shared_ptr<const BakedLight> PictureSlot::Impl::bakedFor(const Session& session,
                                                              const std::string& drawnMode, const How& how) {
    if (drawnMode != "hybrid") return nullptr;
    if (how.still) statics.bake(session, platform::Window::wake);
    if (const std::string failure = statics.status().error; !failure.empty() && how.still)
        throw Error(ErrorKind::Runtime, failure);
    return statics.light(session);
}

void PictureSlot::Impl::followUpdateTime() {
    updateMs = 0;
    for (const PassStats& pass : renderer->stats().passes)
        if (pass.name == "irradiance: update") updateMs += pass.gpuMs >= 0 ? pass.gpuMs : pass.wallMs;
    if (updateMs > 0 && (flyingUpdate || flyingFaces.faces() == 0)) flyingFaces.measured(updateMs);
}

// A change of exposure or tone map shows what was rendered in another light; nothing is rendered.
void PictureSlot::Impl::followLook(const Session& session) {
    const PictureKey key = keyOf(session.revisions());
    const bool rendered = renderer && texture != 0 && texture != cpuTexture.name();
    if (!rendered || !shown || key == *shown || !onlyLook(session)) return;
    texture = renderer->displayTexture(session.settings().image);
    shown = key;
    ++version;
}

bool PictureSlot::Impl::onlyLook(const Session& session) const {
    if (!shown) return false;
    PictureKey before = keyOf(session.revisions());
    before.settings = shown->settings;
    return before == *shown && sameButLook(session.settings(), shownSettings);
}

void PictureSlot::Impl::renderFrame(const Session& session, Settings settings, int w, int h) {
    const double start = wallMs();
    renderer->setProfiling(true, false);
    renderer->setHeadlight(headlight);
    renderer->render(session.camera(), w, h, settings);
    texture = renderer->displayTexture(settings.image);
    linear.reset();
    linearJob = 0;
    if (session.flags().drawBlock) linear = renderer->readImage();
    double gpuMs = 0;
    for (const PassStats& pass : renderer->stats().passes) gpuMs += std::max(pass.gpuMs, 0.0);
    frameMs = std::max(wallMs() - start, gpuMs);
    shown = keyOf(session.revisions());
    shownSettings = session.settings();
    asked = false;
    width = w;
    height = h;
    ++version;
}

// `linear`, tone-mapped, as the texture.
void PictureSlot::Impl::showImage(const ImageSettings& look) {
    cpuTexture.update(linear->width, linear->height, toneMapped(*linear, look));
    cpuLook = look;
    texture = cpuTexture.name();
    width = linear->width;
    height = linear->height;
    ++version;
}

void PictureSlot::Impl::drawNothing(const Session& session, int w, int h) {
    const PictureKey key = keyOf(session.revisions());
    if (shown == key && width == w && height == h && !asked) return;
    const std::size_t pixels = static_cast<std::size_t>(w) * static_cast<std::size_t>(h);
    linear = Image{w, h, std::vector<glm::vec4>(pixels, glm::vec4(session.scene().sky, 0))};
    showImage(session.settings().image);
    shown = key;
    asked = preview = false;
    own = true;
    settling = 0;
}

// By paths or by beams, in the background.
bool PictureSlot::Impl::drawTraced(BackgroundReference& traced, const Session& session, int w, int h,
                                   const How& how) {
    // While the camera moves no new picture is begun: it would not come far.
    if (how.still) traced.refine(session, w, h, kReferenceSamples, platform::Window::wake);
    own = false;
    if (traced.shows(session)) {
        Image newest;
        const bool isNew = traced.take(referenceVersion, newest);
        const ImageSettings& look = session.settings().image;
        if (isNew) {
            linear = std::move(newest);
            linearJob = traced.jobs();
        }
        own = linear && linearJob == traced.jobs();
        if (own && (isNew || look != cpuLook || texture != cpuTexture.name())) showImage(look);
        if (own) {
            preview = false;
            shown = keyOf(session.revisions());
            shownSettings = session.settings();
            return false;
        }
        if (const std::string failure = traced.status().error; !failure.empty())
            throw Error(ErrorKind::Runtime, failure);
    }
    if (!how.preview) return false;
    if (!preview) shown.reset();
    preview = true;
    return drawScene(session, getSetting(session.settings(), "mode"), w, h, how);
}

// The baked scene carries its light in unlit materials, so any mode of the renderer shows it; phong is the
// cheapest.
bool PictureSlot::Impl::drawRadiosity(const Session& session, int w, int h, const How& how) {
    if (how.still) bake.bake(session, platform::Window::wake);
    if (const std::string failure = bake.status().error; !failure.empty() && how.still)
        throw Error(ErrorKind::Runtime, failure);
    const std::shared_ptr<const Scene> newest = bake.lit(session);
    own = newest != nullptr;
    if (!own) {
        if (!how.preview) return false;
        if (!preview) shown.reset();
        preview = true;
        return drawScene(session, getSetting(session.settings(), "mode"), w, h, how);
    }
    preview = false;
    followLook(session);
    const bool changed = asked || !shown || !(*shown == keyOf(session.revisions())) || lit != newest;
    const bool resized = w != width || h != height;
    if (!changed && !resized) return false;
    if (!changed && how.onlyChanges) return true;
    if (!renderer) renderer = std::make_unique<Renderer>(options);
    if (lit != newest) {
        upload.forget();
        renderer->setScene(*newest);
        lit = newest;
    }
    Settings settings = session.settings();
    settings.mode = Mode::Phong;
    settings.component = Component::Full;
    renderer->setDynamic(false);
    renderFrame(session, settings, w, h);
    settling = 0;
    return false;
}

bool PictureSlot::onlyLook(const Session& session) const { return impl_->onlyLook(session); }
std::uint32_t PictureSlot::texture() const { return impl_->texture; }
int PictureSlot::width() const { return impl_->width; }
int PictureSlot::height() const { return impl_->height; }
double PictureSlot::frameMs() const { return impl_->frameMs; }
double PictureSlot::pixelsMs() const { return std::max(impl_->frameMs - impl_->updateMs, 0.0); }
std::uint64_t PictureSlot::version() const { return impl_->version; }

const Image& PictureSlot::linear() { return impl_->read(); }

const Image& PictureSlot::Impl::read() {
    static const Image none;
    if (linear) return *linear;
    // A texture of the renderer's is its last picture.
    if (texture == 0 || !renderer || texture == cpuTexture.name()) return none;
    linear = renderer->readImage();
    return *linear;
}

const FrameStats* PictureSlot::stats() const {
    const bool traced = impl_->mode == "reference" || impl_->mode == "beams";
    const bool drawn = impl_->renderer && (!traced || impl_->preview);
    return drawn ? &impl_->renderer->stats() : nullptr;
}

Renderer* PictureSlot::renderer() {
    return isSettingsMode(impl_->mode) || impl_->preview ? impl_->renderer.get() : nullptr;
}

// Of a picture of the renderer's: how far it is.
std::string PictureSlot::Impl::progress() const {
    const bool hasLight = mode == "traced";
    const std::string noisy =
        hasLight && noise.value() ? fmt::format("  noise {:.1f} %", 100 * *noise.value()) : "";
    if (settling == 0) return hasLight ? noisy + "  done" : "";
    return "  " + passes.text(settling) + noisy;
}

bool PictureSlot::ownPicture() const { return impl_->texture != 0 && impl_->own; }

bool PictureSlot::finished() const {
    if (!impl_->lastError.empty()) return true;  // until something changes
    if (!ownPicture() || impl_->settling > 0) return false;
    if (impl_->mode == "reference") return !impl_->reference.status().running;
    if (impl_->mode == "beams") return !impl_->beams.status().running;
    if (impl_->mode == "hybrid") return !impl_->statics.status().running;
    return impl_->mode != "radiosity" || !impl_->bake.status().running;
}

std::string PictureSlot::label() const {
    const std::string instead = impl_->preview ? "; until then the view without it" : "";
    if (impl_->mode == "reference") {
        const ReferenceStatus status = impl_->reference.status();
        if (!status.error.empty()) return "reference: " + status.error;
        if (status.samplesPerPixel == 0) return "reference: tracing the first samples" + instead;
        return fmt::format("reference  {} spp  noise {:.1f} %{}", status.samplesPerPixel, 100 * status.noise,
                           status.running ? "" : "  done");
    }
    if (impl_->mode == "beams") {
        const ReferenceStatus status = impl_->beams.status();
        if (!status.error.empty()) return status.error;
        return status.samplesPerPixel == 0 ? "beams: tracing" + instead : "beams  done";
    }
    if (impl_->mode == "radiosity") {
        const BakeStatus status = impl_->bake.status();
        if (!status.error.empty()) return "radiosity: " + status.error;
        if (!status.running) return "radiosity";
        const std::string left = status.secondsLeft >= 0 ? ", " + timeText(status.secondsLeft) + " left" : "";
        if (status.refining)
            return fmt::format("radiosity: a draft; baking in full, {:.0f} %{}", 100 * status.done, left);
        return fmt::format("radiosity: baking, {:.0f} %{}{}", 100 * status.done, left,
                           impl_->preview ? instead : "; light as it was before the change");
    }
    if (impl_->mode == "hybrid") return hybridLabel(impl_->statics.status(), impl_->baked != nullptr);
    return impl_->version == 0 ? impl_->mode : impl_->mode + impl_->progress();
}

}  // namespace conelight::program
