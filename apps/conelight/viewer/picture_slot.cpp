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
#include "viewer/picture_key.h"
#include "viewer/picture_label.h"
#include "viewer/picture_noise.h"
#include "viewer/picture_passes.h"

namespace conelight::program {
namespace {

// The background reference rests here: below 1 % noise in closed rooms.
constexpr int kReferenceSamples = 4096;
// What updates of the light cache may take of a picture while the camera flies: a quarter of PictureView's aim.
constexpr double kFlyingUpdateMs = 25;
// Between two parts of a picture the window looks whether somebody wants it.
constexpr double kPartMs = 25;
constexpr double kMovingPartMs = 40;  // of pictures that may take 100 and are to come soon

double wallMs() {
    using clock = std::chrono::steady_clock;
    return std::chrono::duration<double, std::milli>(clock::now().time_since_epoch()).count();
}

}  // namespace

struct PictureSlot::Impl {
    // A picture that is drawn in parts, and what it will show.
    struct Drawing {
        PictureKey key;
        Settings settings;  // the session's
        glm::ivec2 size;
        bool moving = false;  // coarse: it is finished though the view has gone on meanwhile
    };

    RendererOptions options;
    std::unique_ptr<Renderer> renderer;
    std::optional<Drawing> drawing;
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
    std::uint64_t version = 0, parts = 0;
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
    void begin(const Session& session, const std::string& drawnMode, bool voxelsDue, const glm::ivec2& size,
               const How& how);
    void followDrawing(const Session& session, const glm::ivec2& size, const How& how);
    void drop();
    void countPass(const std::string& drawnMode);
    void renderFrame(const Session& session, const Settings& settings, int w, int h);
    void takeFrame(const Session& session, const Drawing& drawn, double start);
    void showImage(const ImageSettings& look);
    const Image& read();
    std::shared_ptr<const BakedLight> bakedFor(const Session& session, const std::string& drawnMode,
                                               const How& how);
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
    drop();
}

void PictureSlot::Impl::drop() {
    if (drawing && renderer) renderer->drop();
    drawing.reset();
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
        impl_->drop();
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

// The scene as it is, in a mode of the renderer, in parts. At rest a picture that nobody wants any more is dropped.
bool PictureSlot::Impl::drawScene(const Session& session, const std::string& drawnMode, int w, int h,
                                  const How& how) {
    followLook(session);
    const std::shared_ptr<const BakedLight> newest = bakedFor(session, drawnMode, how);
    const ViewFlags& flags = session.flags();
    const bool voxelsDue = flags.dynamic && !drawing && wallMs() - voxelsMadeAt > 1e3 * flags.period;
    followDrawing(session, {w, h}, how);
    const bool current = drawing || (shown && *shown == keyOf(session.revisions()));
    const bool changed = asked || !current || voxelsDue || newest != baked;
    const bool resized = !drawing && (w != width || h != height);
    if (changed || (resized && !how.onlyChanges)) {
        passes = passesOf(drawnMode, session.settings(), session.camera());
        settling = passes.all();
    }
    if (settling == 0) return resized && how.onlyChanges;
    if (how.onlyChanges && !changed) return true;

    if (changed) drop();
    if (!drawing) {
        baked = newest;
        begin(session, drawnMode, voxelsDue, {w, h}, how);
    }
    ++parts;
    if (!renderer->goOn(how.still ? kPartMs : kMovingPartMs)) return true;
    const Drawing drawn = *std::exchange(drawing, std::nullopt);
    takeFrame(session, drawn, wallMs() - renderer->stats().wallMs);
    countPass(drawnMode);
    return settling > 0;
}

void PictureSlot::Impl::countPass(const std::string& drawnMode) {
    followUpdateTime();
    const bool view = passes.areViews(settling);
    --settling;
    if (drawnMode == "traced" && !view)
        noise.follow(passes.all() - settling, [this]() -> const Image& { return read(); });
}

// What was begun goes on while it is what is wanted; another look at it changes nothing. What moves is shown as it was a
// moment ago, or nothing would be finished.
void PictureSlot::Impl::followDrawing(const Session& session, const glm::ivec2& size, const How& how) {
    if (!drawing) return;
    if (!how.still && drawing->moving && renderer && renderer->drawing()) return;
    PictureKey key = keyOf(session.revisions());
    if (sameButLook(session.settings(), drawing->settings)) key.settings = drawing->key.settings;
    const bool same = key == drawing->key && drawing->size == size && drawing->moving == !how.still;
    if (same && renderer && renderer->drawing())
        drawing->key.settings = session.revisions().settings;
    else
        drop();
}

void PictureSlot::Impl::begin(const Session& session, const std::string& drawnMode, bool voxelsDue,
                              const glm::ivec2& size, const How& how) {
    if (!renderer) {
        renderer = std::make_unique<Renderer>(options);
        upload.forget();
    }
    if (lit) {
        lit.reset();
        upload.forget();
    }
    upload.follow(*renderer, session);
    renderer->setBakedLight(baked);
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
    asked = false;
    renderer->setProfiling(true, false);
    renderer->setHeadlight(headlight);
    renderer->begin(session.camera(), size.x, size.y, settings);
    drawing = Drawing{keyOf(session.revisions()), session.settings(), size, !how.still};
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

void PictureSlot::Impl::renderFrame(const Session& session, const Settings& settings, int w, int h) {
    const double start = wallMs();
    drop();
    renderer->setProfiling(true, false);
    renderer->setHeadlight(headlight);
    renderer->render(session.camera(), w, h, settings);
    takeFrame(session, {keyOf(session.revisions()), session.settings(), {w, h}}, start);
}

void PictureSlot::Impl::takeFrame(const Session& session, const Drawing& drawn, double start) {
    texture = renderer->displayTexture(session.settings().image);
    linear.reset();
    linearJob = 0;
    if (session.flags().drawBlock) linear = renderer->readImage();
    double gpuMs = 0;
    for (const PassStats& pass : renderer->stats().passes) gpuMs += std::max(pass.gpuMs, 0.0);
    frameMs = std::max(wallMs() - start, gpuMs);
    shown = drawn.key;
    shownSettings = session.settings();
    asked = false;
    width = drawn.size.x;
    height = drawn.size.y;
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

std::uint64_t PictureSlot::parts() const { return impl_->parts + impl_->version; }
bool PictureSlot::drawing() const { return impl_->drawing.has_value(); }
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

bool PictureSlot::ownPicture() const { return impl_->texture != 0 && impl_->own; }

std::string PictureSlot::label() const {
    const Impl& m = *impl_;
    if (m.mode == "reference") return referenceLabel(m.reference.status(), m.preview);
    if (m.mode == "beams") return beamsLabel(m.beams.status(), m.preview);
    if (m.mode == "radiosity") return radiosityLabel(m.bake.status(), m.preview);
    if (m.mode == "hybrid") return hybridLabel(m.statics.status(), m.baked != nullptr);
    return m.version == 0 ? m.mode : passesLabel(m.mode, m.passes, m.settling, m.noise.value());
}

bool PictureSlot::finished() const {
    if (!impl_->lastError.empty()) return true;  // until something changes
    if (!ownPicture() || impl_->settling > 0) return false;
    if (impl_->mode == "reference") return !impl_->reference.status().running;
    if (impl_->mode == "beams") return !impl_->beams.status().running;
    if (impl_->mode == "hybrid") return !impl_->statics.status().running;
    return impl_->mode != "radiosity" || !impl_->bake.status().running;
}

}  // namespace conelight::program
