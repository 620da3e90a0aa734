// SPDX-License-Identifier: MIT
// Mode `hybrid`: light baked on what does not move (Scene::baked), and cones for the difference that moving things
// make to it and for the light on these. Without baked light it is mode `cones`. docs/guide/hybrid_mode.md
#pragma once

#include <vector>

#include "gather/cone_picture.h"
#include "gather/cone_volume.h"
#include "gather/hybrid_diffuse.h"
#include "gather/static_volume.h"
#include "image/voxel_view.h"
#include "modes/mode.h"
#include "voxels/voxels.h"

namespace conelight::modes {

class HybridMode : public ModeRenderer {
  public:
    void draw(const Frame& frame) override;
    // As in mode `cones`.
    bool needsShadows(const Scene&, const Settings&) const override { return true; }
    bool readsCascades() const override { return true; }

    static std::vector<gl::ProgramDesc> programDescs();

  private:
    void updateVolumes(const Frame& frame);
    void drawVoxels(const Frame& frame);
    void record(const Frame& frame);
    const gather::ConeVolume& shown() const { return moves_ ? volume_ : statics_.volume(); }

    bool moves_ = true;  // something is seen that light was not baked on
    gather::StaticVolume statics_;
    voxels::Voxels voxels_;      // of all
    gather::ConeVolume volume_;  // of all
    gather::HybridDiffuse diffuse_;
    gather::ConePicture picture_;
    image::VoxelView voxelView_;
};

}  // namespace conelight::modes
