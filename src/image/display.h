// SPDX-License-Identifier: MIT
// The picture as a screen shows it, on the GPU: what toneMapped() gives, as a texture, without a read-back.
#pragma once

#include <optional>
#include <vector>

#include "conelight/renderer.h"
#include "conelight/settings.h"
#include "gl/buffer.h"
#include "gl/device.h"
#include "gl/texture.h"
#include "image/bloom.h"
#include "image/exposure.h"

namespace conelight::image {

class Display {
  public:
    // `linear` (RGBA32F, row 0 at the bottom) -> texture(). Ends with the barrier for texture fetches. GL
    // state changed: program and its slots.
    void draw(const gl::Device& device, const gl::Texture& linear, const ImageSettings& settings,
              RowOrder rows);
    const gl::Texture& texture() const { return texture_; }  // RGBA8

    static std::vector<gl::ProgramDesc> programDescs();

  private:
    gl::Texture texture_;
    Exposure exposure_;
    std::optional<Bloom> bloom_;  // while there is any
    gl::Buffer constants_;
};

}  // namespace conelight::image
