// SPDX-License-Identifier: MIT
// Bloom: part of the light spreads about where it falls, as in an eye or a lens (docs/theory/5_image.md, "Bloom").
// A chain of halved pictures and back (Jimenez 2014, "Next Generation Post Processing in Call of Duty: Advanced
// Warfare"): linear radiance -> the light that spreads. No light is added: what spreads is missing where it came from.
// Radii are parts of the picture's height, whatever its pixels.
#pragma once

#include <array>
#include <vector>

#include "conelight/renderer.h"
#include "gl/buffer.h"
#include "gl/device.h"
#include "gl/texture.h"

namespace conelight::image {

// How much of the light that spreads each level of the chain brings; a level has pixels of 2^level of the picture's.
// They add up to 1; level 0 is the picture itself.
constexpr int kBloomLevels = 12;
using BloomWeights = std::array<float, kBloomLevels + 1>;
BloomWeights bloomWeights(int width, int height);

// On the CPU: the picture with `strength` of its light spread, 0..1; pixels that are not finite spread nothing.
Image bloomed(const Image& image, float strength);

// On the GPU, as a value.
class Bloom {
  public:
    // `linear`: RGBA32F, at least 2 x 2. Ends with the barrier for texture fetches. GL state changed: program and its
    // slots.
    void spread(const gl::Device& device, const gl::Texture& linear);
    void declare(gl::Inputs& inputs) const;  // bloomChain
    // Of the last spread(): what level 0 has, and the chain's first level the rest.
    float weightOfPicture() const { return weights_[0]; }

    static std::vector<gl::ProgramDesc> programDescs();

  private:
    gl::Texture chain_;  // level 0 is level 1 of the weights
    gl::Sampler linear_;
    gl::Buffer constants_;
    BloomWeights weights_{};
};

}  // namespace conelight::image
