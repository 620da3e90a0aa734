// SPDX-License-Identifier: MIT
// A gathered picture as another view sees it, a part of a pixel beside its own (docs/theory/5_image.md,
// "Edges"): picture of lib/pixel_history.glsl + surfaces -> the same for those surfaces. No rays. Part of
// gather::Indirect.
//
// Readers need gl::barrier(TextureFetch). GL state changed: program and its slots.
#pragma once

#include <vector>

#include "gather/pixel_rays.h"

namespace conelight::gather {

class CarriedPicture {
  public:
    struct From {
        const gl::Texture& picture;
        const gpu::FrameConstants& view;  // that it was gathered with
        const PixelRectangle* lobes;      // where a picture of lobes has anything; null: one of irradiance
        float specularLimit;
        bool coats = false;  // of lobes of coats
        bool cached = true;  // the cache stands in for what no pixel of the picture shows
    };
    // `inputs.surfaces`: the other view; of another size it shows the same, with more pixels.
    const gl::Texture& carry(const gl::Device& device, const RayInputs& inputs, const From& from);

    static std::vector<gl::ProgramDesc> programDescs();

  private:
    gl::Texture texture_;
    gl::Buffer constants_;
};

}  // namespace conelight::gather
