// SPDX-License-Identifier: MIT
// Mode `thesis`: the renderer of the thesis, its volume and its cones, with the original's defects mended or
// switched on (docs/guide/thesis_mode.md).
#pragma once

#include <optional>

#include "gather/voxel_view.h"
#include "modes/frame_context.h"
#include "thesis/render/cones.h"
#include "thesis/render/volume.h"

namespace conelight::modes {

class ThesisMode : public ModeRenderer {
  public:
    void render(const FrameContext& frame) override;
    bool needsShadows(const Settings& settings) const override;
    void record(const FrameContext& frame, gather::StepRecorder& recorder) override;
    // The original culls: its rooms are looked into through their front walls.
    bool cullsBackFaces() const override { return true; }

    static std::vector<gl::ProgramDesc> programDescs();

  private:
    void updateVolume(const FrameContext& frame);

    voxels::ThesisVolume volume_;
    gather::ThesisConePass cones_;
    gather::VoxelView voxelView_;
    std::optional<voxels::ThesisVolumeOptions> builtFor_;
};

}  // namespace conelight::modes
