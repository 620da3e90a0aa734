// SPDX-License-Identifier: MIT
#include "image/temporal_picture.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "gl/gl.h"
#include "gl/picture_pass.h"
#include "shared/image.h"
#include "view/surfaces.h"
#include "voxels/voxels.h"

namespace conelight::image {
namespace {

// Views in a mean. At rest: as many as a still has at most. On the way: longer ones blur and lag, shorter ones
// flicker (`conelight score edges`).
constexpr std::uint32_t kLongestAtRest = 64;
constexpr std::uint32_t kLongestMoving = 16;
// What came on the way counts as so many views at rest: it lags, and is in focus.
constexpr std::uint32_t kKeptAtRest = 4;

struct TemporalKey {
    bool still;
    bool vertices;  // have moved
    gl::ProgramDesc desc() const {
        return {{"image/temporal_picture.comp.glsl"},
                {{"STILL", still ? "1" : "0"}, {"VERTICES", vertices ? "1" : "0"}}};
    }
    static std::vector<TemporalKey> all() { return {{false, false}, {false, true}, {true, false}}; }
};

// What has no part in linear radiance, or changes from frame to frame and leaves the picture what it is.
Settings withoutLook(Settings settings) {
    settings.image = ImageSettings{};
    settings.voxels = voxels::withoutAnchor(settings.voxels);
    settings.traced.faceBudget = 0;
    settings.traced.timeBudget = 0;
    return settings;
}

glm::vec3 directionOf(const Camera& camera) {
    const glm::vec3 view = camera.target - camera.eye;
    const float length = glm::length(view);
    return length > 0 ? view / length : glm::vec3(0, 0, -1);
}

}  // namespace

// Turned by more than half of what it sees: little of the picture before is left. Steps aside are found by
// the pixels.
bool TemporalPicture::isCut(const Camera& camera) const {
    const float turned =
        std::acos(std::clamp(glm::dot(directionOf(camera), directionOf(*camera_)), -1.0f, 1.0f));
    return turned > 0.5f * camera.fovY;
}

void TemporalPicture::resize(int width, int height) {
    if (width_ == width && height_ == height) return;
    for (gl::Texture* old : {&view_, &history_, &places_[0], &places_[1]}) *old = {};  // freed first
    view_ = gl::Texture({GL_TEXTURE_2D, GL_RGBA32F, width, height}, "temporal: view");
    history_ = gl::Texture({GL_TEXTURE_2D, GL_RGBA32F, width, height}, "temporal: picture before");
    for (gl::Texture& places : places_) {
        places = gl::Texture({GL_TEXTURE_2D, GL_R32UI, width, height}, "temporal: depth and views");
        places.parameter(GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        places.parameter(GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    }
    width_ = width;
    height_ = height;
    frame_ = 0;
}

// Objects that come and go leave nothing of themselves behind.
void TemporalPicture::followInstances(const scene::GpuScene& scene) {
    const base::Revision at = instances_.at();
    const std::vector<scene::InstanceChange>& changes = instances_.look(scene);
    const auto any = [&](auto&& is) { return std::any_of(changes.begin(), changes.end(), is); };
    const bool moved = any([](const scene::InstanceChange& one) { return one.moved || one.reshaped; });
    if ((at != instances_.at() && !moved) || instances_.fewer() ||
        any([](const scene::InstanceChange& one) { return one.came; }))
        frame_ = 0;
    const bool before = std::exchange(moved_, moved && frame_ > 0);
    if (moved_ || before || frame_ == 0) putMotion(scene, changes);
}

// Where each instance was in the frame before. A matrix of zeros: its shape has changed; nothing is known of where its
// points were, unless the surfaces tell it.
void TemporalPicture::putMotion(const scene::GpuScene& scene,
                                const std::vector<scene::InstanceChange>& changes) {
    std::vector<glm::mat4> matrices =
        scene::oldFromWorld(scene, moved_ ? changes : std::vector<scene::InstanceChange>());
    if (moved_)
        for (const scene::InstanceChange& change : changes)
            if (change.reshaped) matrices[change.index] = glm::mat4(0);
    motion_ = gl::Buffer(matrices, "temporal: motion");
}

void TemporalPicture::follow(const Shown& shown) {
    frame_ += drawn_ ? 1 : 0;
    // A frame that was left before it was added: what it knew of movement is gone.
    const bool left = !std::exchange(drawn_, false);
    const bool lost = left && moved_;
    resize(shown.width, shown.height);
    const scene::GpuScene& scene = shown.scene;
    const From now{scene.identity(), scene.geometryRevision(), scene.lightRevision(), scene.skyRevision(),
                   scene.bakedRevision()};
    const Settings settings = withoutLook(shown.settings);
    if (lost || !camera_ || from_.scene != now.scene || !(settings_ == settings) || isCut(shown.camera))
        frame_ = 0;
    followInstances(scene);
    still_ = !left && frame_ > 0 && from_ == now && camera_ == shown.camera;
    camera_ = shown.camera;
    geometryBefore_ = from_.geometry;
    settings_ = settings;
    from_ = now;
}

view::PixelPart TemporalPicture::part(bool settled) {
    still_ = still_ && settled;
    view::PixelPart part = view::pixelPartOfFrame(frame_);
    rested_ = still_ ? rested_ + 1 : 0;
    if (!still_) part.lens = glm::dvec2(0);
    return part;
}

base::Steps TemporalPicture::add(const gl::Device& device, const scene::GpuScene& scene,
                                 const view::Surfaces& centers, const gl::Texture& picture) {
    if (!constants_) constants_ = gl::Buffer(sizeof(gpu::TemporalPictureConstants), "temporal constants");
    gpu::TemporalPictureConstants constants{};
    constants.oldClipFromWorld = viewBefore_.clipFromWorld;
    const glm::vec3& forward = viewBefore_.viewForward;
    constants.oldDepth = glm::vec4(forward, -glm::dot(forward, viewBefore_.eye));
    constants.oldParallel = viewBefore_.parallel;
    constants.longest =
        still_ ? std::min(kLongestAtRest, kKeptAtRest + static_cast<std::uint32_t>(rested_)) : kLongestMoving;
    constants.fresh = fresh() ? 1 : 0;
    constants_.update(constants);
    gl::barrier(gl::Access::TextureFetch | gl::Access::ImageAccess);
    gl::Inputs given;
    given.add(scene)
        .add(centers)
        .uniform("TemporalBlock", constants_)
        .storage("Motion", motion_)
        .texture("view", view_)
        .texture("pictureBefore", history_)
        .texture("placesBefore", places_[0])
        .image("places", places_[1], gl::ImageUse::Write)
        .image("picture", picture, gl::ImageUse::Write);
    const bool vertices = !still_ && centers.movedFrom() && centers.movedFrom() == geometryBefore_;
    if (vertices) given.texture("surfaceMotion", centers.moved());
    const gl::ProgramDesc desc = TemporalKey{still_, vertices}.desc();
    const glm::ivec2 size(width_, height_);
    co_await gl::dispatchPicture(device, {"temporal", desc, given, size});
    gl::barrier(gl::Access::TextureFetch | gl::Access::Framebuffer | gl::Access::ImageAccess |
                gl::Access::Update);
    history_.copyFrom(picture);
    std::swap(places_[0], places_[1]);
    viewBefore_ = centers.view();
    drawn_ = true;
}

std::vector<gl::ProgramDesc> TemporalPicture::programDescs() {
    std::vector<gl::ProgramDesc> descs;
    for (const TemporalKey& key : TemporalKey::all()) descs.push_back(key.desc());
    return descs;
}

}  // namespace conelight::image
