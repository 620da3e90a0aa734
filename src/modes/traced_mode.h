// SPDX-License-Identifier: MIT
// Mode `traced`: surface voxels -> irradiance per voxel face by rays, over and over -> at pixels the cache,
// or more rays -> picture. The order of passes of the mode is render(). Voxels are rebuilt when the geometry
// changed, light when lights changed. docs/guide/traced_mode.md
#pragma once

#include <memory>
#include <vector>

#include "modes/frame_context.h"

namespace conelight::modes {

class TracedMode : public ModeRenderer {
  public:
    TracedMode();
    ~TracedMode() override;
    void render(const FrameContext& frame) override;
    bool needsShadows(const Settings& settings) const override;
    void record(const FrameContext& frame, gather::StepRecorder& recorder) override;

    static std::vector<gl::ProgramDesc> programDescs();

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace conelight::modes
