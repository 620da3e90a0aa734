// SPDX-License-Identifier: MIT
// Mode `thesis`: the renderer of the thesis, its volume and its cones, with the original's defects mended or
// switched on (docs/guide/thesis_mode.md).
#pragma once

#include <optional>

#include "image/voxel_view.h"
#include "modes/mode.h"
#include "thesis/render/cones.h"
#include "thesis/render/volume.h"

namespace conelight::thesis {

class ThesisMode : public modes::ModeRenderer {
  public:
    base::Steps drawInSteps(const modes::Frame& frame) override;
    bool needsShadows(const Scene& scene, const Settings& settings) const override;
    // In the thesis's program emissive objects light nothing (a defect).
    bool lightsFromEmitters(const Settings& settings) const override;

    static std::vector<gl::ProgramDesc> programDescs();

  private:
    base::Steps updateVolume(const modes::Frame& frame);
    void drawVoxels(const modes::Frame& frame);

    ThesisVolume volume_;
    ThesisConePass cones_;
    image::VoxelView voxelView_;
    // What the volume was made from.
    base::Revision sceneFrom_, lightsFrom_;
    std::optional<ThesisVolumeOptions> options_;
};

}  // namespace conelight::thesis
