// SPDX-License-Identifier: MIT
// Where the surfaces of a picture were in the picture before, when vertices have moved on their mesh: by how much each
// point was elsewhere in the world. Instances that have moved are drawn once more, and count where the G-buffer shows
// them; so nothing is drawn, and nothing kept, as long as no mesh changes its vertices. Part of view::Surfaces.
#pragma once

#include <optional>
#include <vector>

#include "base/revision.h"
#include "gl/device.h"
#include "gl/draw.h"
#include "gl/texture.h"
#include "scene/gpu_scene.h"
#include "scene/instance_history.h"
#include "shared/gbuffer.h"
#include "view/gbuffer.h"

namespace conelight::view {

class MotionPicture {
  public:
    // Looks what has moved since the last call: whether vertices have.
    bool follow(const scene::GpuScene& scene);
    // Draws it. `frameBlock`, `gbuffer`: of the picture, drawn. GL state changed: raster state, vertex array, program and
    // its slots.
    void draw(const gl::Device& device, const scene::GpuScene& scene, const gl::Buffer& frameBlock,
              const GBuffer& gbuffer);
    // Whether the picture tells more than the matrices of instances.
    bool drawn() const { return drawn_; }
    // Geometry of the scene in the picture before.
    base::Revision from() const { return from_; }
    // RGBA32F: world position then less now, m; 0 where nothing has moved; a below 0: nobody knows.
    const gl::Texture& texture() const { return picture_; }

    static std::vector<gl::ProgramDesc> programDescs();

  private:
    base::Revision scene_, from_;
    scene::InstanceHistory instances_;
    std::vector<gpu::InstanceMotion> motions_;
    std::vector<char> moves_;  // of the instances
    gl::Buffer table_;
    gl::Texture picture_;
    std::optional<gl::Framebuffer> framebuffer_;
    bool drawn_ = false;
};

}  // namespace conelight::view
