// SPDX-License-Identifier: MIT
// The public face of the library: scene, lights and surfaces are values that every mode starts from; the
// mode's recipe (modes/*_mode.cpp) makes the image of them.
#include "conelight/renderer.h"

#include <cmath>
#include <utility>

#include "base/log.h"
#include "gl/copy.h"
#include "gl/debug.h"
#include "gl/gl.h"
#include "gl/storage.h"
#include "modes/memory_stats.h"
#include "modes/renderer_values.h"

namespace conelight {

Renderer::Renderer(const RendererOptions& options) {
    gl::requireContext();
    if (options.reportGlErrors) gl::installDebugCallback();
    const std::uint32_t owner = gl::newOwner();
    const gl::OwnerScope own(owner);
    impl_ = std::make_unique<Impl>(options);
    impl_->owner = owner;
    impl_->deviceName = gl::rendererName();
}

Renderer::~Renderer() {
    // Without the context, what it held is gone with it or cannot be freed.
    std::optional<gl::ForgetNames> forget;
    if (!gl::hasCurrentContext()) forget.emplace();
    impl_.reset();
}

void Renderer::setScene(const Scene& scene) {
    scene.validate();  // a scene that is refused leaves the old one in place
    const modes::OwnerGuard call(impl_->owner);
    const gl::WorkScope told(impl_->work);
    impl_->work.begin();
    impl_->drop();
    impl_->mode.reset();  // light of another scene says nothing of this one
    impl_->fit.forget();
    impl_->scene.set(scene);
}

void Renderer::setInstance(std::size_t index, const Instance& instance) {
    impl_->changed()->setInstance(index, instance);
}
void Renderer::setMesh(std::size_t index, const Mesh& mesh) { impl_->changed()->setMesh(index, mesh); }
void Renderer::setMesh(std::size_t index, const HostMesh& mesh) {
    impl_->changed()->setMesh(impl_->device, index, mesh);
}
void Renderer::setTexture(std::size_t index, const Texture& texture) {
    impl_->changed()->setTexture(index, texture);
}
void Renderer::setTexture(std::size_t index, const HostTexture& texture) {
    impl_->changed()->setTexture(impl_->device, index, texture);
}
void Renderer::setMaterial(std::size_t index, const Material& material) {
    impl_->changed()->setMaterial(index, material);
}
void Renderer::setLight(std::size_t index, const Light& light) { impl_->changed()->setLight(index, light); }
void Renderer::setLights(const std::vector<Light>& lights) { impl_->changed()->setLights(lights); }
void Renderer::setSky(const glm::vec3& radiance) { impl_->changed()->setSky(radiance); }
void Renderer::setEnvironment(const Environment& environment) {
    impl_->changed()->setEnvironment(environment);
}
void Renderer::setBakedLight(std::shared_ptr<const BakedLight> baked) {
    impl_->changed()->setBakedLight(std::move(baked));
}
std::size_t Renderer::addMesh(const Mesh& mesh) { return impl_->changed()->addMesh(mesh); }
std::size_t Renderer::addMesh(const HostMesh& mesh) { return impl_->changed()->addMesh(impl_->device, mesh); }
std::size_t Renderer::addTexture(const Texture& texture) { return impl_->changed()->addTexture(texture); }
std::size_t Renderer::addTexture(const HostTexture& texture) {
    return impl_->changed()->addTexture(impl_->device, texture);
}
std::size_t Renderer::addMaterial(const Material& material) {
    return impl_->changed()->addMaterial(material);
}
std::size_t Renderer::addInstance(const Instance& instance) {
    return impl_->changed()->addInstance(instance);
}
void Renderer::removeInstance(std::size_t index) { impl_->changed()->removeInstance(index); }
void Renderer::removeMesh(std::size_t index) { impl_->changed()->removeMesh(index); }
void Renderer::setRegion(const Aabb& region) { impl_->changed()->setRegion(region); }
const Scene& Renderer::scene() const { return impl_->scene.require("scene").source(); }

void Renderer::setProfiling(bool passes, bool lookups, bool dispatches) {
    impl_->profiler.setEnabled(passes);
    impl_->countLookups = lookups;
    impl_->countDispatches = dispatches;
}

void Renderer::setHeadlight(float irradiance) {
    if (!(irradiance >= 0 && std::isfinite(irradiance)))
        base::fail(ErrorKind::Usage, "setHeadlight: %g; 0 W/m^2 or more would be right",
                   static_cast<double>(irradiance));
    if (std::exchange(impl_->headlightIrradiance, irradiance) == irradiance) return;
    const modes::OwnerGuard call(impl_->owner);
    impl_->drop();
    impl_->temporal.reset();  // a mean over frames that had another
}
void Renderer::setDynamic(bool everyFrame) { impl_->everyFrame = everyFrame; }
void Renderer::setLightHeld(bool held) { impl_->lightHeld = held; }

std::vector<std::string> Renderer::reloadShaders() {
    const modes::OwnerGuard call(impl_->owner);
    impl_->drop();
    std::vector<std::string> failures = impl_->programs.reload(impl_->programs.sourceFiles());
    impl_->mode.reset();  // what the old programs left in volumes and shadow maps is theirs
    impl_->lights = {};
    return failures;
}

// Throws what is wrong with it.
void Renderer::Impl::require(const WantedPicture& asked) {
    const int width = asked.width, height = asked.height;
    if (width < 1 || height < 1 || width > view::kMaxEdge || height > view::kMaxEdge)
        base::fail(ErrorKind::Usage, "picture of %d x %d; 1 to %d in each direction would be right", width,
                   height, view::kMaxEdge);
    view::requireUsable(asked.camera);
    validateSettings(asked.settings);
    scene.require("render");
    gl::requireLiveContext();
}

void Renderer::render(const Camera& camera, int width, int height, const Settings& settings) {
    if (width == 0 || height == 0) return;  // of a window that is minimised
    const Impl::WantedPicture asked{camera, width, height, settings};
    impl_->require(asked);
    const modes::OwnerGuard call(impl_->owner);
    const gl::WorkScope told(impl_->work);
    impl_->work.begin();
    impl_->drop();
    impl_->renderWithin(asked).finish();
    gl::requireLiveContext();
}

void Renderer::begin(const Camera& camera, int width, int height, const Settings& settings) {
    const Impl::WantedPicture asked{camera, width, height, settings};
    impl_->require(asked);
    impl_->work.begin();
    impl_->drop();
    impl_->inParts = gl::isSoftwareDriver();
    impl_->cpuMs = impl_->wallMs = 0;
    impl_->steps = impl_->renderWithin(asked);
}

bool Renderer::goOn(double milliseconds) {
    if (!drawing())
        base::fail(ErrorKind::Usage, "goOn: no picture was begun; begin before it would be right");
    gl::requireLiveContext();
    const modes::OwnerGuard call(impl_->owner);
    const gl::WorkScope told(impl_->work);
    const bool finished = impl_->goOn(milliseconds);
    gl::requireLiveContext();
    return finished;
}

void Renderer::drop() { impl_->drop(); }
bool Renderer::drawing() const { return !impl_->steps.done(); }
PictureWork Renderer::work() const {
    const gl::Work::Piece piece = impl_->work.now();
    return {piece.name, piece.done, piece.total};
}

Image Renderer::readImage() const {
    if (!impl_->image)
        base::fail(ErrorKind::Usage, "readImage: nothing was rendered; render before it would be right");
    const modes::OwnerGuard call(impl_->owner);
    return impl_->image.read();
}

PixelInspection Renderer::inspectPixel(int x, int y) {
    const image::LinearImage& image = impl_->image;
    if (!image)
        base::fail(ErrorKind::Usage, "inspectPixel: nothing was rendered; render before it would be right");
    if (x < 0 || y < 0 || x >= image.width() || y >= image.height())
        base::fail(ErrorKind::Usage,
                   "inspectPixel: pixel %d,%d of a picture of %d x %d; 0,0 to %d,%d would be right", x, y,
                   image.width(), image.height(), image.width() - 1, image.height() - 1);
    const modes::OwnerGuard call(impl_->owner);
    impl_->drop();
    return impl_->inspect(x, y);
}

std::uint32_t Renderer::imageTexture() const {
    if (!impl_->image) return 0;
    const gl::Texture& picture = impl_->image.texture();
    if (impl_->rows == RowOrder::BottomFirst) return picture.name();
    const modes::OwnerGuard call(impl_->owner);
    gl::Texture& turned = impl_->turned;
    if (!turned || turned.width() != picture.width() || turned.height() != picture.height()) {
        turned = {};
        turned =
            gl::Texture({picture.desc().target, picture.desc().format, picture.width(), picture.height()},
                        "turned image");
    }
    gl::copyToTexture(picture, turned.name(), gl::Rows::Turned);
    return turned.name();
}

std::uint32_t Renderer::displayTexture(const ImageSettings& settings) {
    if (!impl_->image) return 0;
    const modes::OwnerGuard call(impl_->owner);
    impl_->display.draw(impl_->device, impl_->image.texture(), settings, impl_->rows);
    return impl_->display.texture().name();
}

void Renderer::copyToFramebuffer(std::uint32_t framebuffer, int x, int y) const {
    if (!impl_->image)
        base::fail(ErrorKind::Usage, "copyToFramebuffer: nothing was rendered; render before it");
    const modes::OwnerGuard call(impl_->owner);
    gl::copyToFramebuffer(impl_->image.texture(), framebuffer, {x, y});
}

void Renderer::copyToTexture(std::uint32_t texture) const {
    if (!impl_->image) base::fail(ErrorKind::Usage, "copyToTexture: nothing was rendered; render before it");
    const modes::OwnerGuard call(impl_->owner);
    const bool turned = impl_->rows == RowOrder::TopFirst;
    gl::copyToTexture(impl_->image.texture(), texture, turned ? gl::Rows::Turned : gl::Rows::AsTheyAre);
}

const FrameStats& Renderer::stats() const {
    impl_->stats.memory = modes::memoryStats(impl_->owner);
    return impl_->stats;
}

}  // namespace conelight
