// SPDX-License-Identifier: MIT
// A texture of the host's (conelight/host_texture.h) -> its layer in the array that compute shaders index, by a pass on
// the GPU.
#pragma once

#include <string>
#include <vector>

#include "conelight/host_texture.h"
#include "gl/device.h"
#include "gl/texture.h"

namespace conelight::scene {

// Throws Error(BadInput) for a name of no texture, and for textures that are of no use.
void requireUsable(const HostTexture& texture);

// What a scene has in its place.
Texture whiteTexel(const std::string& name);

class HostTextureImport {
  public:
    // Level 0 is the mean of texels, or repeats them; each other level is the mean of four. `array`: square layers, an
    // edge that is a power of two, GL_SRGB8_ALPHA8. Visible to all later passes.
    void copy(const gl::Device& device, const HostTexture& texture, gl::Texture& array, int layer);

    static std::vector<gl::ProgramDesc> programDescs();

  private:
    gl::Texture linear_, encoded_;  // of one layer, all levels
    gl::Sampler nearest_;
};

}  // namespace conelight::scene
