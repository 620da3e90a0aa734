// SPDX-License-Identifier: MIT
// Glass in front of a picture: picture + surfaces + lights' glass -> the picture with what glass tints, reflects
// and refracts (docs/theory/4h_glass.md).
//
// Readers of the picture need gl::barrier(TextureFetch). GL state changed: program and its slots.
#pragma once

#include <vector>

#include "gather/cone_shadows.h"
#include "gather/direct_light.h"
#include "gather/picture_parts.h"
#include "gather/pixel_rays.h"

namespace conelight::gather {

class Glass {
  public:
    struct Wanted {
        PictureParts parts;
        int passes = 1;       // of two rays each
        int firstPass = 0;    // their number among all that make a picture
        int reflections = 0;  // on metals, of one ray
    };
    // By rays through the voxels; `picture` holds what is behind, of the same parts.
    base::Steps drawByRays(const gl::Device& device, const RayInputs& inputs, Wanted wanted,
                           const gl::Texture& picture);
    // By a reflected and a refracted cone per pixel through the volume that `cones` gives.
    base::Steps drawByCones(const gl::Device& device, const DirectInputs& inputs, const ConeShadows& cones,
                            PictureParts parts, const gl::Texture& picture);
    // As tinted panes that bend nothing and reflect lights alone.
    base::Steps drawStraight(const gl::Device& device, const DirectInputs& inputs, PictureParts parts,
                             const gl::Texture& picture);

    static std::vector<gl::ProgramDesc> programDescs();
    // By cones; `defines` are all that ConeShadows may have.
    static std::vector<gl::ProgramDesc> coneDescs(const std::vector<gl::Defines>& defines);

  private:
    gl::Buffer constants_;
    gl::Texture sums_;
};

}  // namespace conelight::gather
