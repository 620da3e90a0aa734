// SPDX-License-Identifier: MIT
// The steps of one pixel's cones or rays: the buffer that shaders with RECORD_STEPS write
// (shaders/lib/record_steps.glsl) -> PixelInspection.
//
// A pass is recorded by its own program's recording variant, dispatched for one group: dispatch(1, 1). Reads
// what the pass reads. GL state changed: program and its slots.
#pragma once

#include "conelight/inspect.h"
#include "gl/buffer.h"
#include "gl/device.h"

namespace conelight::gather {

class StepRecorder {
  public:
    // Row 0 is the bottom row.
    explicit StepRecorder(const glm::ivec2& pixel);

    // `desc` as its recording variant.
    static gl::ProgramDesc variant(gl::ProgramDesc desc);
    // One pass that counts for `share` of the mean; `desc` is a recording variant, `inputs` what the pass
    // reads.
    void record(const gl::Device& device, const gl::ProgramDesc& desc, gl::Inputs inputs, float share = 1.0f);

    // Everything but x, y, mode and picture. Waits for the GPU.
    PixelInspection read() const;

  private:
    gl::Buffer buffer_;
};

}  // namespace conelight::gather
