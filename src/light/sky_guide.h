// SPDX-License-Identifier: MIT
// Where each cell of the grid sees the sky: updates of the cache count the rays that found it, and rays of pixels are
// guided there (shaders/lib/sky_guide.glsl). Method: docs/theory/4c_estimator.md, "Windows". Part of light::IrradianceCache.
//
// The mean of light does not depend on it, only its noise. The same calls give the same bits: rays are counted.
#pragma once

#include <vector>

#include "gl/device.h"

namespace conelight::light {

class SkyGuide {
  public:
    // Makes room, before rays are guided or counted.
    void reserve();
    // Forgets all.
    void restart();
    // What rays have counted -> where those of pixels go, for a part of the cells, by the number of the update.
    // `constants`: gpu::CacheConstants.
    void learn(const gl::Device& device, const gl::Buffer& constants);

    void declare(gl::Inputs& inputs) const;                 // skyGuide
    void declareLearned(gl::Inputs& inputs) const;          // SkyLearnedTable, which updates count in
    const gl::Buffer& buffer() const { return guide_; }     // of shared/sky_guide.h, for tests
    const gl::Buffer& learned() const { return learned_; }  // likewise

    static std::vector<gl::ProgramDesc> programDescs();

  private:
    gl::Buffer learned_, guide_;
    gl::Texture guideTexels_;
};

}  // namespace conelight::light
