// SPDX-License-Identifier: MIT
// Mode `cones`: surface voxels -> injected light -> radiance volume -> diffuse and specular cones at every
// pixel, over shadow-mapped direct light. The order of passes and barriers of the mode is render().
// Voxels are rebuilt when the geometry changed, light when lights changed, and neither until a component
// needs them. docs/guide/cones_mode.md
#pragma once

#include <memory>
#include <vector>

#include "modes/frame_context.h"

namespace conelight::modes {

class ConesMode : public ModeRenderer {
  public:
    ConesMode();
    ~ConesMode() override;
    void render(const FrameContext& frame) override;
    bool needsShadows(const Settings& settings) const override;
    void record(const FrameContext& frame, gather::StepRecorder& recorder) override;

    static std::vector<gl::ProgramDesc> programDescs();

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace conelight::modes
