// SPDX-License-Identifier: MIT
// Diffuse light of mode `hybrid`: baked light at pixels, and the difference that moving things make to what cones
// gather. docs/theory/4i_hybrid.md
#pragma once

#include <vector>

#include "gather/baked_pixels.h"
#include "gather/cone_volume.h"
#include "gather/direct_light.h"
#include "gather/static_volume.h"

namespace conelight::gather {

class HybridDiffuse {
  public:
    // `all`: the volume of the whole scene, in the grid of `statics`; null: nothing moves. `counters` not null: adds
    // lookups of cones. Readers need the barrier for texture fetches. GL state changed: as BakedPixels::draw.
    struct Inputs {
        const DirectInputs& pixels;
        const StaticVolume& statics;
        const ConeVolume* all;
    };
    base::Steps drawInSteps(const gl::Device& device, const Inputs& inputs, const gl::Buffer* counters);
    const gl::Texture& irradiance() const { return result_; }  // / pi, rgb

    static std::vector<gl::ProgramDesc> programDescs();

  private:
    BakedPixels baked_;
    gl::Texture result_, all_, static_;
};

}  // namespace conelight::gather
