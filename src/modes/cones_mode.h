// SPDX-License-Identifier: MIT
// Mode `cones`: voxels -> radiance volume -> diffuse and specular cones at every pixel, over shadow-mapped
// direct light. docs/guide/cones_mode.md
#pragma once

#include <vector>

#include "gather/cone_picture.h"
#include "gather/cone_volume.h"
#include "image/voxel_view.h"
#include "light/lit_voxels.h"
#include "modes/mode.h"
#include "voxels/voxels.h"

namespace conelight::modes {

class ConesMode : public ModeRenderer {
  public:
    base::Steps drawInSteps(const Frame& frame) override;
    base::Steps drawGlass(const Frame& frame) override;
    // Every component that this mode draws has lit voxels or direct light in it.
    bool needsShadows(const Scene&, const Settings&) const override { return true; }
    bool readsCascades() const override { return true; }
    bool lightsFromSmallLamps() const override { return true; }
    bool castsCaustics() const override { return true; }
    bool seesVeils() const override { return true; }

    static std::vector<gl::ProgramDesc> programDescs();

  private:
    base::Steps updateVolume(const Frame& frame);
    void record(const Frame& frame);
    void drawVoxels(const Frame& frame);

    voxels::Voxels voxels_;
    light::LitVoxels lit_;  // with cones.indirect=cache
    gather::ConeVolume volume_;
    gather::ConePicture picture_;
    image::VoxelView voxelView_;
};

}  // namespace conelight::modes
