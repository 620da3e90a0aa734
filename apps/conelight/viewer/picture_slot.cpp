// SPDX-License-Identifier: MIT
#include "viewer/picture_slot.h"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <utility>

#include "conelight/error.h"
#include "platform/window.h"
#include "traced_picture.h"
#include "viewer/picture_key.h"
#include "viewer/picture_label.h"
#include "viewer/picture_passes.h"
#include "viewer/picture_slot_values.h"

namespace conelight::program {
namespace {

// The background reference rests here: below 1 % noise in closed rooms.
constexpr int kReferenceSamples = 4096;
// Between two parts of a picture the window looks whether somebody wants it.
constexpr double kPartMs = 25;
constexpr double kLongPiece = 0.5;    // s, chosen: what lasts so long is named in the label
constexpr double kMovingPartMs = 40;  // of pictures that may take 100 and are to come soon

double wallMs() {
    using clock = std::chrono::steady_clock;
    return std::chrono::duration<double, std::milli>(clock::now().time_since_epoch()).count();
}

}  // namespace

PictureSlot::PictureSlot(RendererOptions options, platform::RenderThread& thread)
    : impl_(std::make_unique<Impl>(std::move(options), thread)) {}
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
    renderer.forget();
    drawing.reset();
}

void PictureSlot::blank() { impl_->startAnew(); }
void PictureSlot::drop() { impl_->drop(); }
std::string PictureSlot::work() const { return drawing() ? workLabel(impl_->renderer.work()) : ""; }

void PictureSlot::clear() {
    impl_->startAnew();
    impl_->bake.stop();
    impl_->statics.stop();
    impl_->baked.reset();
    impl_->renderer.free();
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
    std::vector<std::string> failures;
    impl_->renderer.run([&](Renderer& renderer) { failures = renderer.reloadShaders(); });
    return failures;
}

bool PictureSlot::draw(const Session& session, const std::string& mode, int width, int height,
                       const How& how) {
    if (mode != impl_->mode) {
        impl_->startAnew();
        impl_->mode = mode;
    }
    try {
        impl_->due = impl_->draw(session, width, height, how);
        if (!how.onlyChanges) impl_->lastError.clear();
        return impl_->due;
    } catch (const std::exception& error) {
        // Not tried again before something changes.
        impl_->shown = keyOf(session.revisions());
        impl_->shownSettings = session.settings();
        impl_->width = width;
        impl_->height = height;
        impl_->settling = 0;
        impl_->asked = impl_->due = false;
        impl_->drop();
        if (impl_->lastError != error.what()) impl_->error = error.what();
        impl_->lastError = error.what();
        return false;
    }
}

std::optional<std::string> PictureSlot::takeError() { return std::exchange(impl_->error, std::nullopt); }

bool PictureSlot::Impl::draw(const Session& session, int w, int h, const How& how) {
    if (!renderer.rests()) return true;
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
    takeFinished(session, drawnMode);
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
        if (!giveScene(session)) return true;
        baked = newest;
        begin(session, drawnMode, voxelsDue, {w, h}, how);
    }
    const double part = how.still ? kPartMs : kMovingPartMs;
    renderer.begin([part](Renderer& made) { return made.goOn(part); });
    if (!renderer.rests()) return true;
    takeFinished(session, drawnMode);
    return drawing || settling > 0;
}

// A picture whose last part has ended. What changed since it was begun is in the next one.
void PictureSlot::Impl::takeFinished(const Session& session, const std::string& drawnMode) {
    if (!renderer.takeFinished() || !drawing) return;
    Drawing drawn = *std::exchange(drawing, std::nullopt);
    if (sameButLook(session.settings(), drawn.settings)) {
        drawn.key.settings = session.revisions().settings;
        drawn.settings = session.settings();
    }
    takeFrame(session, drawn, wallMs() - renderer.resting().stats().wallMs);
    countPass(drawnMode);
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
    const bool drawn = renderer && renderer.resting().drawing();
    if (!how.still && drawing->moving && drawn) return;
    PictureKey key = keyOf(session.revisions());
    if (sameButLook(session.settings(), drawing->settings)) key.settings = drawing->key.settings;
    const bool same = key == drawing->key && drawing->size == size && drawing->moving == !how.still;
    if (same && drawn)
        drawing->key.settings = session.revisions().settings;
    else
        drop();
}

// Returns whether the renderer has the session's scene, or begin() may give it. Beside the window it takes a copy of what
// it needs as a whole.
bool PictureSlot::Impl::giveScene(const Session& session) {
    if (renderer.make() || std::exchange(lit, nullptr)) upload.forget();
    if (!renderer.isBeside() || !upload.needsWhole(renderer.resting(), session)) return true;
    renderer.begin([this, scene = session.scene(), at = SceneUpload::revisionsOf(session)](Renderer& made) {
        upload.take(made, scene, at);
        return false;
    });
    return renderer.rests();
}

void PictureSlot::Impl::begin(const Session& session, const std::string& drawnMode, bool voxelsDue,
                              const glm::ivec2& size, const How& how) {
    if (voxelsDue) voxelsMadeAt = wallMs();
    Settings settings = session.shownSettings();
    conelight::setSetting(settings, "mode", drawnMode);
    settings.traced.budgeted = true;  // the window stays live; the picture settles over frames
    const bool views = passes.areViews(settling);
    settings.image.temporal = views || smoothsEdges(drawnMode, settings) ? Toggle::On : Toggle::Off;
    const int faces = flyingFaces.faces();
    flyingUpdate = how.flying && faces > 0;
    if (flyingUpdate && (settings.traced.faceBudget == 0 || settings.traced.faceBudget > faces))
        settings.traced.faceBudget = faces;
    asked = false;
    renderer.run([&](Renderer& made) {
        upload.follow(made, session);
        made.setBakedLight(baked);
        made.setLightHeld(views);
        made.setDynamic(voxelsDue);
        made.setProfiling(true, false);
        made.setHeadlight(headlight);
        made.begin(session.camera(), size.x, size.y, settings);
    });
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
    for (const PassStats& pass : stats.passes)
        if (pass.name == "irradiance: update") updateMs += pass.gpuMs >= 0 ? pass.gpuMs : pass.wallMs;
    if (updateMs > 0 && (flyingUpdate || flyingFaces.faces() == 0)) flyingFaces.measured(updateMs);
}

// A change of exposure or tone map shows what was rendered in another light; nothing is rendered.
void PictureSlot::Impl::followLook(const Session& session) {
    const PictureKey key = keyOf(session.revisions());
    const bool rendered = renderer && texture != 0 && texture != cpuTexture.name();
    if (!rendered || !shown || key == *shown || !onlyLook(session)) return;
    renderer.run([&](Renderer& made) { texture = made.displayTexture(session.settings().image); });
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
    asked = false;
    renderer.run([&](Renderer& made) {
        made.setDynamic(false);
        made.setProfiling(true, false);
        made.setHeadlight(headlight);
        made.render(session.camera(), w, h, settings);
    });
    takeFrame(session, {keyOf(session.revisions()), session.settings(), {w, h}}, start);
}

void PictureSlot::Impl::takeFrame(const Session& session, const Drawing& drawn, double start) {
    linear.reset();
    linearJob = 0;
    renderer.run([&](Renderer& made) {
        texture = made.displayTexture(session.settings().image);
        if (session.flags().drawBlock) linear = made.readImage();
        stats = made.stats();
    });
    double gpuMs = 0;
    for (const PassStats& pass : stats.passes) gpuMs += std::max(pass.gpuMs, 0.0);
    frameMs = std::max(wallMs() - start, gpuMs);
    shown = drawn.key;
    shownSettings = drawn.settings;
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
    renderer.make();
    if (lit != newest) {
        upload.forget();
        renderer.run([&](Renderer& made) { made.setScene(*newest); });
        lit = newest;
    }
    Settings settings = session.settings();
    settings.mode = Mode::Phong;
    settings.component = Component::Full;
    renderFrame(session, settings, w, h);
    settling = 0;
    return false;
}

std::uint64_t PictureSlot::parts() const { return impl_->renderer.pieces() + impl_->version; }
bool PictureSlot::drawing() const {
    return impl_->drawing || impl_->renderer.works() || impl_->renderer.inspecting();
}
bool PictureSlot::works() const { return impl_->renderer.works(); }
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
    renderer.run([this](Renderer& made) { linear = made.readImage(); });
    return *linear;
}

const FrameStats* PictureSlot::stats() const {
    const bool traced = impl_->mode == "reference" || impl_->mode == "beams";
    const bool drawn = impl_->renderer && (!traced || impl_->preview);
    return drawn ? &impl_->stats : nullptr;
}

bool PictureSlot::inspects() const {
    return impl_->renderer && (isSettingsMode(impl_->mode) || impl_->preview);
}

PixelInspection PictureSlot::inspectPixel(const glm::ivec2& pixel) {
    PixelInspection found;
    impl_->renderer.run([&](Renderer& made) { found = made.inspectPixel(pixel.x, pixel.y); });
    return found;
}

void PictureSlot::beginInspection(const glm::ivec2& pixel) { impl_->renderer.beginInspection(pixel); }
std::optional<PixelInspection> PictureSlot::takeInspection() { return impl_->renderer.takeInspection(); }

bool PictureSlot::ownPicture() const { return impl_->texture != 0 && impl_->own; }

std::string PictureSlot::label() const {
    const Impl& m = *impl_;
    if (m.mode == "reference") return referenceLabel(m.reference.status(), m.preview);
    if (m.mode == "beams") return beamsLabel(m.beams.status(), m.preview);
    if (m.mode == "radiosity") return radiosityLabel(m.bake.status(), m.preview);
    if (m.mode == "hybrid") return hybridLabel(m.statics.status(), m.baked != nullptr);
    const std::string work = m.renderer.worksSince(kLongPiece) ? "  " + workLabel(m.renderer.work()) : "";
    return (m.version == 0 ? m.mode : passesLabel(m.mode, m.passes, m.settling, m.noise.value())) + work;
}

bool PictureSlot::finished() const {
    if (!impl_->lastError.empty()) return true;  // until something changes
    if (!ownPicture() || impl_->due || impl_->settling > 0 || impl_->renderer.inspecting()) return false;
    if (impl_->mode == "reference") return !impl_->reference.status().running;
    if (impl_->mode == "beams") return !impl_->beams.status().running;
    if (impl_->mode == "hybrid") return !impl_->statics.status().running;
    return impl_->mode != "radiosity" || !impl_->bake.status().running;
}

}  // namespace conelight::program
