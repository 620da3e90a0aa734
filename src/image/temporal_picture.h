// SPDX-License-Identifier: MIT
// Temporal accumulation, as a value: the picture of a moving view with smooth edges. Each frame draws one view
// at an offset within a pixel; it is added to the picture before, which follows the camera and what moves
// (docs/theory/5_image.md, "Over frames"). Karis 2014, "High Quality Temporal Supersampling"; Salvi 2016, "An Excursion
// in Temporal Supersampling".
//
// Starts anew: at the first frame, after another scene, size or setting, and after a cut. Pictures of the same
// calls are the same, bit by bit. GL state changed: program and its slots.
#pragma once

#include <optional>
#include <vector>

#include "base/revision.h"
#include "base/steps.h"
#include "conelight/settings.h"
#include "gl/buffer.h"
#include "gl/device.h"
#include "gl/texture.h"
#include "scene/instance_history.h"
#include "view/camera.h"

namespace conelight::view {
class Surfaces;
}

namespace conelight::image {

class TemporalPicture {
  public:
    // What a frame shows.
    struct Shown {
        const scene::GpuScene& scene;
        const Camera& camera;
        int width, height;
        const Settings& settings;
    };
    // A frame begins: looks what has changed since the one before.
    void follow(const Shown& shown);
    // Nothing is known yet: the frame is the picture of the pixels' centres.
    bool fresh() const { return frame_ == 0; }
    int frame() const { return frame_; }  // since it started anew
    // The frame shows what the one before did.
    bool still() const { return still_; }
    // The frame's view. `settled`: the same picture again would be of the same light. Offsets on the lens are
    // taken at rest only: what moves is in focus.
    view::PixelPart part(bool settled);
    // RGBA32F, to draw that view to.
    const gl::Texture& view() const { return view_; }
    // When fresh(): the picture of the pixels' centres takes its place. Before: barrier(Update).
    void takeCenters(const gl::Texture& picture) { view_.copyFrom(picture); }
    // The frame's view, drawn, and the pictures before -> `picture`, RGBA32F of the same size. `centers`: what is
    // seen at the pixels' centres. Ends with the barriers for texture fetches, images and framebuffers.
    base::Steps add(const gl::Device& device, const scene::GpuScene& scene, const view::Surfaces& centers,
                    const gl::Texture& picture);

    static std::vector<gl::ProgramDesc> programDescs();

  private:
    // What the picture before was made from.
    struct From {
        base::Revision scene, geometry, light, sky, baked;
        bool operator==(const From&) const = default;
    };
    void resize(int width, int height);
    void followInstances(const scene::GpuScene& scene);
    void putMotion(const scene::GpuScene& scene, const std::vector<scene::InstanceChange>& changes);
    bool isCut(const Camera& camera) const;

    gl::Texture view_, history_, places_[2];  // places_[0]: of history_
    gl::Buffer constants_, motion_;
    scene::InstanceHistory instances_;
    int width_ = 0, height_ = 0;
    int frame_ = 0;
    int rested_ = 0;  // frames at rest
    bool moved_ = false, still_ = false, drawn_ = false;
    std::optional<Camera> camera_;
    gpu::FrameConstants viewBefore_{};
    Settings settings_;
    From from_;
    base::Revision geometryBefore_;
};

}  // namespace conelight::image
