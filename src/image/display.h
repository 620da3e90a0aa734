// SPDX-License-Identifier: MIT
// The picture as a screen shows it, on the GPU: what toneMapped() gives, as a texture, without a read-back.
#pragma once

#include <vector>

#include "conelight/settings.h"
#include "gl/buffer.h"
#include "gl/program.h"
#include "gl/texture.h"

namespace conelight::image {

class Display {
  public:
    // `linear` (RGBA32F, row 0 at the bottom) -> texture(). GL state changed: program, image 0, UNIT_PASS,
    // BINDING_PASS. Ends with the barrier for texture fetches.
    void draw(gl::ProgramLibrary& programs, const gl::Texture& linear, const ImageSettings& settings);
    const gl::Texture& texture() const { return texture_; }  // RGBA8, row 0 is the top row

    static std::vector<gl::ProgramDesc> programDescs();

  private:
    gl::Texture texture_;
    gl::Buffer constants_;
};

}  // namespace conelight::image
