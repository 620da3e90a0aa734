// SPDX-License-Identifier: MIT
// What part of its emission each face shows, so that it fits the faces' sizes as rays meet them
// (shaders/light/emission_fit.comp.glsl). It depends on voxels alone, and is made anew with them.
#pragma once

#include <vector>

#include "base/revision.h"
#include "base/steps.h"
#include "gl/device.h"
#include "scene/gpu_scene.h"
#include "voxels/voxels.h"

namespace conelight::light {

class EmissionFit {
  public:
    void update(const gl::Device& device, const scene::GpuScene& scene, const voxels::Voxels& voxels) {
        updateInSteps(device, scene, voxels).finish();
    }
    base::Steps updateInSteps(const gl::Device& device, const scene::GpuScene& scene,
                              const voxels::Voxels& voxels);
    void declare(gl::Inputs& inputs) const;  // emissionParts: R32UI, a float per face

    static std::vector<gl::ProgramDesc> programDescs();

  private:
    gl::Buffer parts_;
    gl::Texture texels_;
    base::Revision voxelsFrom_;
};

}  // namespace conelight::light
