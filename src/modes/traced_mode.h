// SPDX-License-Identifier: MIT
// Mode `traced`: voxels -> irradiance per voxel face by rays, over and over -> at pixels the cache, or more
// rays -> picture. docs/guide/traced_mode.md
#pragma once

#include <vector>

#include "gather/indirect.h"
#include "gather/layer_shade.h"
#include "gather/pixel_visibility.h"
#include "gather/traced_shade.h"
#include "image/voxel_view.h"
#include "light/lit_voxels.h"
#include "light/relight_budget.h"
#include "modes/mode.h"
#include "voxels/voxels.h"

namespace conelight::modes {

class TracedMode : public ModeRenderer {
  public:
    base::Steps drawInSteps(const Frame& frame) override;
    base::Steps drawGlass(const Frame& frame) override;
    bool gathersForCenters() const override { return true; }
    bool settled() const override { return lit_.steady(); }
    // Every component has lit voxels or direct light in it, or leaves them behind for the next.
    bool needsShadows(const Scene&, const Settings&) const override { return true; }
    bool readsCascades() const override { return true; }
    bool lightsFromSmallLamps() const override { return true; }
    bool castsCaustics() const override { return true; }
    bool seesVeils() const override { return true; }
    bool drawsLamps() const override { return true; }

    static std::vector<gl::ProgramDesc> programDescs();

  private:
    gl::Device deviceFor(const Frame& given);
    base::Steps voxelize(const Frame& frame);
    base::Steps relight(const Frame& frame);
    void record(const Frame& frame, const gather::RayInputs& inputs, const gather::Indirect::Redraw& redraw);

    voxels::VoxelGrid grid_;  // of the last picture, with several levels
    voxels::Voxels voxels_;
    light::LitVoxels lit_;
    light::RelightBudget budget_;
    gather::Indirect indirect_;
    gather::PixelVisibility visibility_;
    gather::TracedShade shade_;
    gather::LayerShade layers_;
    image::VoxelView voxelView_;
};

}  // namespace conelight::modes
