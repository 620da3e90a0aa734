// SPDX-License-Identifier: MIT
// Coat and sheen over a picture of what lies below them: surfaces with layers + lights + gathered light -> the picture, at
// the pixels that have layers (gather/layer_shade.comp.glsl). Readers need the barriers that the picture's pass asks for,
// which are issued. GL state changed: program and its slots, the indirect dispatch buffer binding.
#pragma once

#include <vector>

#include "gather/direct_light.h"
#include "gather/picture_parts.h"
#include "gather/pixel_list.h"
#include "gather/pixel_rays.h"

namespace conelight::gather {

class LayerShade {
  public:
    // What was gathered, one of three. Pictures of lib/pixel_history.glsl, null: irradiance from the cache, which stands
    // in for the coat's lobe, too. Or pictures of cones. The cache needs `rays`.
    struct Gathered {
        const gl::Texture* irradiance = nullptr;
        const gl::Texture* lobe = nullptr;
        const gl::Texture* coneIrradiance = nullptr;
        const gl::Texture* coneLobe = nullptr;
    };
    struct Wanted {
        PictureParts parts;
        Gathered gathered;
        float specularLimit = 1;                  // rougher coats show the irradiance
        const gl::Texture* visibility = nullptr;  // of lights (PixelVisibility); null: by shadow maps
        const RayInputs* rays = nullptr;          // for the cache; null: there is none
    };
    // `output` holds the picture of what lies below: RGBA32F.
    base::Steps drawInSteps(const gl::Device& device, const DirectInputs& inputs, const Wanted& wanted,
                            const gl::Texture& output);

    static std::vector<gl::ProgramDesc> programDescs();

  private:
    struct Key;
    const gl::Buffer& listPixels(const gl::Device& device, const DirectInputs& inputs,
                                 const gl::Inputs& given, const gl::Texture& output);

    gl::Buffer constants_, list_;
    std::size_t listedPixels_ = 0;
    gl::Texture sheenTable_;
};

}  // namespace conelight::gather
