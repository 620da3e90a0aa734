// SPDX-License-Identifier: MIT
// Caustics: the light that solids of glass gather and send elsewhere. Lights + tree of glass + voxels -> a map per
// solid of the light that leaves it, over the directions from its middle (lib/caustic_map.glsl). Part of
// light::Lights. Method: docs/theory/4h_glass.md, "Caustics".
//
// Limits: the first CAUSTIC_SOLIDS solids; light of the lights of the table; where light ends is what voxels show
// of it.
#pragma once

#include <vector>

#include "gl/device.h"
#include "gl/texture.h"
#include "scene/glass_tree.h"
#include "scene/gpu_scene.h"
#include "shared/caustics.h"
#include "voxels/voxels.h"

namespace conelight::light {

class Lights;

class Caustics {
  public:
    struct Inputs {
        const scene::GpuScene& scene;
        const Lights& lights;
        const voxels::Voxels& voxels;  // with octant words
    };

    // No solid has a map.
    void clear();
    // `paths` through each solid from each light. Ends with the barrier for texture fetches. GL state changed:
    // programs and their slots.
    base::Steps castInSteps(const gl::Device& device, const Inputs& inputs,
                            const std::vector<scene::GlassSolid>& solids, int paths);
    void declare(gl::Inputs& inputs) const;  // CausticBlock, causticMap; after clear() or castInSteps()
    bool any() const { return constants_.count > 0; }
    const gl::Texture& map() const { return map_; }

    static std::vector<gl::ProgramDesc> programDescs();

  private:
    base::Steps castSolid(const gl::Device& device, const Inputs& inputs, std::uint32_t solid, int paths);
    void layOut(std::size_t solids, int paths);

    gpu::CausticConstants constants_{};
    gl::Buffer block_, passBlock_, ends_, sums_;
    gl::Texture map_;
};

}  // namespace conelight::light
