// SPDX-License-Identifier: MIT
// Which lights without extent each pixel sees: surfaces, shadow maps, voxels -> R32UI texture, bit n for light n of
// the table (of the first 32). Where shadow maps leave it open a ray asks the triangles that voxels list.
// docs/theory/3_light.md, "Edges by rays".
//
// Readers need a texture-fetch barrier. GL state changed: program and its slots.
#pragma once

#include <vector>

#include "base/steps.h"
#include "gl/device.h"
#include "gl/texture.h"
#include "light/lights.h"
#include "scene/gpu_scene.h"
#include "view/surfaces.h"
#include "voxels/voxels.h"

namespace conelight::gather {

struct VisibilityInputs {
    const scene::GpuScene& scene;
    const light::Lights& lights;
    const voxels::Voxels& voxels;  // with octant words
    const view::Surfaces& surfaces;

    void declare(gl::Inputs& inputs) const;
};

class PixelVisibility {
  public:
    // Whether rays have anything to add: there are lights without extent, with shadows that are not filtered, and
    // all that casts them is in the voxels.
    static bool serves(const scene::GpuScene& scene, const light::Lights& lights);

    // `lookupCounters`: not null: adds lookups, as those of occlusion.
    base::Steps lookInSteps(const gl::Device& device, const VisibilityInputs& inputs,
                            const gl::Buffer* lookupCounters);
    const gl::Texture& seen() const { return seen_; }  // what it has found

    static std::vector<gl::ProgramDesc> programDescs();

  private:
    gl::Texture seen_;
    gl::Buffer open_;  // the pixels of which maps leave something open
};

}  // namespace conelight::gather
