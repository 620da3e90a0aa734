// SPDX-License-Identifier: MIT
// What was gathered at surfaces, as textures for a host (GatheredLight of conelight/light_field.h).
#pragma once

#include <vector>

#include "gather/indirect.h"
#include "gl/device.h"
#include "gl/draw.h"
#include "gl/texture.h"

namespace conelight::gather {

class LightOutputs {
  public:
    // Of what `indirect` holds for `inputs.surfaces`; irradiance that it lacks is taken from the cache. GL state
    // changed: raster state, vertex array, program and its slots.
    void draw(const gl::Device& device, const RayInputs& inputs, const Indirect& indirect,
              float specularLimit);

    // RGBA16F, of the size of the surfaces.
    const gl::Texture& diffuse() const { return diffuse_; }
    const gl::Texture& specular() const { return specular_; }

    static std::vector<gl::ProgramDesc> programDescs();

  private:
    gl::Texture diffuse_, specular_;
    gl::Framebuffer target_;
    gl::Buffer constants_;
    gl::VertexArray noVertices_;
};

}  // namespace conelight::gather
