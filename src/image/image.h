// SPDX-License-Identifier: MIT
// The image, as a value: linear radiance of each pixel, RGBA32F, row 0 at the bottom; alpha is 1 where a
// surface was seen. Made by the mode's last pass.
#pragma once

#include "conelight/renderer.h"
#include "gl/texture.h"

namespace conelight::image {

class LinearImage {
  public:
    // Allocates; content undefined until a mode has drawn. Nothing for the size that it has.
    void resize(int width, int height);
    explicit operator bool() const { return static_cast<bool>(texture_); }
    int width() const { return texture_.width(); }
    int height() const { return texture_.height(); }
    const gl::Texture& texture() const { return texture_; }

    Image read() const;  // first row on top; waits for the GPU
    // One pixel, counted from the upper left corner; waits for the GPU.
    glm::vec4 readPixel(int x, int y) const;

  private:
    gl::Texture texture_;
};

}  // namespace conelight::image
