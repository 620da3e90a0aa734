// SPDX-License-Identifier: MIT
// Baked light at pixels: BakedLight + surfaces -> irradiance / pi where a pixel shows a surface that it was baked
// on (rgb; a: 1), elsewhere 0. Its mesh is drawn over the G-buffer, whose instance and depth say what is seen.
//
// Limit: along edges of triangles that the mesh divides a pixel may be missed; readers look at its neighbours.
#pragma once

#include <vector>

#include "base/revision.h"
#include "gl/buffer.h"
#include "gl/device.h"
#include "gl/draw.h"
#include "gl/texture.h"
#include "scene/gpu_scene.h"
#include "view/surfaces.h"

namespace conelight::gather {

class BakedPixels {
  public:
    // `scene` has baked light. Readers need the barrier for texture fetches. GL state changed: raster state, program
    // and its slots, vertex array.
    void draw(const gl::Device& device, const scene::GpuScene& scene, const view::Surfaces& surfaces);
    const gl::Texture& irradiance() const { return irradiance_; }

    static std::vector<gl::ProgramDesc> programDescs();

  private:
    void upload(const BakedLight& baked);

    gl::Buffer vertices_, indices_;
    gl::VertexArray mesh_;
    std::uint32_t indexCount_ = 0;
    gl::Texture irradiance_;
    gl::Framebuffer target_;
    base::Revision from_;  // baked light
};

}  // namespace conelight::gather
