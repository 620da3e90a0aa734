// SPDX-License-Identifier: MIT
// The environment's picture as rays and cones find it: Scene::environment -> a texture of levels, and a table by
// which directions are drawn in proportion to its light. Part of light::Lights.
#pragma once

#include <memory>

#include "conelight/scene.h"
#include "gl/buffer.h"
#include "gl/inputs.h"
#include "gl/texture.h"
#include "shared/lighting.h"

namespace conelight::light {

class EnvironmentTable {
  public:
    // Throws Error(Runtime) when memory runs out. Returns at once when the picture is the one it was made of.
    void update(const Environment& environment);
    bool hasPicture() const { return static_cast<bool>(picture_); }

    // What shaders know of it beside the textures; strength and rotation are those of `environment`.
    void describe(const Environment& environment, gpu::LightingConstants& constants) const;
    // environmentPicture, environmentCells; nothing without a picture.
    void declare(gl::Inputs& inputs) const;

  private:
    std::shared_ptr<const EnvironmentImage> from_;
    // RGB9E5, of a width that is a power of two and twice the height, with all levels. Values are scaled, so that
    // the brightest fits.
    gl::Texture picture_;
    gl::Buffer cellBuffer_;
    gl::Texture cells_;  // reads cellBuffer_
    float scale_ = 0;    // W/(sr m^2) of a texel value of 1, at strength 1
    float inverseFlux_ = 0;
    int cellLevel_ = 0;
};

}  // namespace conelight::light
