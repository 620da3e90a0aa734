// SPDX-License-Identifier: MIT
#include "figures/studio.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "conelight/error.h"
#include "io/image_file.h"
#include "io/scene_file.h"
#include "picture_file.h"
#include "session/inspection_lines.h"
#include "session/picker.h"
#include "session/session.h"
#include "session/why_black.h"

namespace conelight::figures {
namespace {

constexpr int kSmallestVoxels = 32;

}  // namespace

Studio::Studio(program::Size size, bool small, const program::ViewOptions& view, program::Progress& progress)
    : size_(size),
      small_(small),
      view_(view),
      progress_(progress),
      source_(std::make_unique<program::PictureSource>(view)) {}

Studio::~Studio() = default;

void Studio::restart() {
    source_ = std::make_unique<program::PictureSource>(view_);
    loadedName_.clear();
}

std::string Studio::device() const { return source_->device(); }

const Scene& Studio::scene(const std::string& spec) {
    if (loadedName_ != spec) {
        progress_.show("loading " + spec);
        auto fresh = std::make_unique<Scene>(io::loadScene(spec));
        completeScene(*fresh);
        source_->setScene(*fresh);
        loaded_ = std::move(fresh);
        loadedName_ = spec;
    }
    return *loaded_;
}

program::PictureRequest Studio::requestOf(const Shot& shot, const Scene& scene) const {
    program::PictureRequest request;
    request.mode = shot.mode;
    const bool onCpu = !program::isRendererMode(shot.mode);
    request.settings = program::startSettings(scene, onCpu ? "cones" : shot.mode);
    request.settings.voxels.size = small_ ? std::max(shot.voxels / 4, kSmallestVoxels) : shot.voxels;
    for (const auto& [key, value] : shot.settings) setSetting(request.settings, key, value);
    program::ViewOptions view;
    view.camera = shot.camera;
    request.camera = program::cameraFor(scene, view);
    request.size = size_;
    request.components = {program::componentOf(shot.component)};
    request.settings.component = request.components.front();
    request.reference.bounces = request.radiosity.bounces = shot.bounces;
    if (shot.denoised) request.denoiser = reference::Denoiser::Own;
    request.reference.samplesPerPixel = small_ ? std::min(shot.samples, 8) : shot.samples;
    if (small_) {
        request.radiosity.maxSubdivision = 1;
        request.radiosity.patchRays = request.radiosity.gatherRays = request.radiosity.visibilityRays = 32;
    }
    return request;
}

program::Picture Studio::picture(const program::PictureRequest& request) {
    program::Picture picture = source_->draw(request, &progress_);
    if (picture.stopped) throw program::InterruptedError();
    return picture;
}

namespace {

Panel panelOf(const std::string& label, const Image& image, const ImageSettings& settings) {
    if (program::isBlack(image, settings))
        throw Error(ErrorKind::Runtime, fmt::format("a picture of the figure ({}) is black", label));
    return {label, ".png", io::pngBytes({image.width, image.height, 3, toneMapped(image, settings)})};
}

}  // namespace

Panel Studio::draw(const std::string& label, const Shot& shot) {
    const program::PictureRequest request = requestOf(shot, scene(shot.scene));
    return panelOf(label, picture(request).images.front(), request.settings.image);
}

Panel Studio::draw(const std::string& label, const Shot& shot, const Scene& changed) {
    auto kept = std::make_unique<Scene>(changed);
    completeScene(*kept);
    source_->setScene(*kept);
    given_ = std::move(kept);
    loadedName_.clear();
    const program::PictureRequest request = requestOf(shot, *given_);
    return panelOf(label, picture(request).images.front(), request.settings.image);
}

Panel Studio::inspect(const std::string& label, const Shot& shot, double x, double y) {
    const Scene& loaded = scene(shot.scene);
    const program::PictureRequest request = requestOf(shot, loaded);
    program::Picture drawn = picture(request);
    const PixelInspection found = source_->inspect(request, std::min(int(x * size_.width), size_.width - 1),
                                                   std::min(int(y * size_.height), size_.height - 1));
    program::Session session(loaded, shot.scene, request.settings, request.mode, request.camera);
    program::Picker picker;
    const float aspect = float(size_.width) / float(size_.height);
    const float exposure = request.settings.image.exposure.resolve(autoExposure(drawn.images.front()));
    for (const program::PictureLine& line :
         program::inspectionLines(found, request.camera, aspect, -1, program::seenFrom(picker, session)))
        program::drawLine(drawn.images.front(), line, std::exp2(-exposure));
    return panelOf(label, drawn.images.front(), request.settings.image);
}

}  // namespace conelight::figures
