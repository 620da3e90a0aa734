// SPDX-License-Identifier: MIT
// Surfaces, as a value: what each pixel of a picture sees, and the matrices that it was seen with. Scene +
// camera -> G-buffer and frame block.
#pragma once

#include <optional>

#include "gl/device.h"
#include "scene/gpu_scene.h"
#include "shared/frame.h"
#include "view/camera.h"
#include "view/gbuffer.h"
#include "view/host_surfaces.h"
#include "view/layer_picture.h"
#include "view/motion_picture.h"
#include "view/shadow_cascades.h"

namespace conelight::view {

class Surfaces {
  public:
    Surfaces();

    // Where surfaces were in the picture before (movedFrom), once vertices have moved. Kept: the next picture may draw it.
    enum class Motion { None, Kept, Drawn };

    // Draws what the camera sees, width x height >= 1. GL state changed: as GBuffer::draw. Ends with the
    // barrier for texture fetches.
    struct Picture {
        Camera camera;
        int width, height;
        bool cullBackFaces;
        PixelPart part = {};
        bool withGlass = false;                    // else what is behind it
        float shrink = 0;                          // ViewSettings::shrink
        const ShadowCascades* cascades = nullptr;  // about the camera, as long as the surfaces; none: null
        Motion motion = Motion::None;
    };
    void see(const gl::Device& device, const scene::GpuScene& scene, const Picture& picture) {
        seeInSteps(device, scene, picture).finish();
    }
    base::Steps seeInSteps(const gl::Device& device, const scene::GpuScene& scene, const Picture& picture);
    // What a host has drawn, usable (requireUsable), one of reduction x reduction pixels. GL state changed: as
    // HostSurfaceImport. Ends with the barrier for texture fetches.
    void take(const gl::Device& device, const scene::GpuScene& scene, const HostSurfaces& host,
              int reduction);
    explicit operator bool() const { return gbuffer_.has_value(); }

    // Whether a host drew them: what materials of the scene say of gloss does not hold then, but this.
    bool areHosts() const { return import_.has_value(); }
    bool mayHaveLobes() const { return hostsLobes_; }
    // Whether pixels say where they were in the picture before: by vectors of a host's, or by how much their surface has
    // moved in the world, once vertices have (MotionPicture).
    bool haveMotion() const { return motion_ != 0 || movedFrom(); }
    const glm::vec2& motionScale() const { return motionScale_; }
    // Of the host's vectors one of so many in each direction is a pixel's; 0: they are of the world.
    int motionStep() const { return motion_ != 0 ? reduction_ : 0; }
    // Geometry of the scene in the picture before, where MotionPicture says what has moved since.
    base::Revision movedFrom() const {
        return motion_ == 0 && moved_ && moved_->drawn() ? moved_->from() : base::Revision{};
    }
    const gl::Texture& moved() const { return moved_->texture(); }

    // Whether pixels have shadow maps about the eye.
    bool haveCascades() const { return cascades_ != nullptr && cascades_->levels() > 0; }

    // Whether anything that may be seen has a coat or sheen. A host's pixels have none.
    bool haveLayers() const { return layers_.has_value(); }

    // FrameBlock, gbufferGeometry, gbufferMaterial; surfaceLayers, hostMotion and what cascades have, if there is any.
    void declare(gl::Inputs& inputs) const;
    int width() const { return gbuffer_->width(); }
    int height() const { return gbuffer_->height(); }
    const gpu::FrameConstants& view() const { return view_; }
    const gl::Texture& depth() const {
        return gbuffer_->depth();
    }  // GBuffer::depth; of a host: 0 where there is a surface

  private:
    std::optional<GBuffer> gbuffer_;
    std::optional<LayerPicture> layers_;
    std::optional<MotionPicture> moved_;
    gpu::FrameConstants view_{};
    gl::Buffer block_;
    std::optional<HostSurfaceImport> import_;
    bool hostsLobes_ = false;
    // Of the host's picture, as long as it is there.
    gl::Name motion_ = 0;
    glm::vec2 motionScale_{1.0f};
    int reduction_ = 1;
    const ShadowCascades* cascades_ = nullptr;

    void resize(int width, int height);
    void prepareLayers(const scene::GpuScene& scene);
    void follow(const gl::Device& device, const scene::GpuScene& scene, Motion motion);
};

}  // namespace conelight::view
