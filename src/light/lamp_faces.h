// SPDX-License-Identifier: MIT
// Light of lamps that are drawn by chance, on voxel faces (light/lamp_faces.comp.glsl): voxels + lights + LitFaces with all
// other direct light -> the faces' radiance with the lamps'. Each round draws once for every face; what a face shows is
// the mean of all rounds since lights or voxels changed. Part of light::LitVoxels.
//
// GL state changed: program and its slots. Ends with the barrier for shader storage and texture fetches.
#pragma once

#include <cstdint>
#include <vector>

#include "base/steps.h"
#include "gl/device.h"
#include "light/lights.h"
#include "light/lit_faces.h"
#include "scene/gpu_scene.h"
#include "voxels/voxels.h"

namespace conelight::light {

class LampFaces {
  public:
    struct Inputs {
        const scene::GpuScene& scene;
        const Lights& lights;
        const voxels::Voxels& voxels;
        const LitFaces& faces;
    };
    // After the faces were given all other light: the first round, of all of them.
    base::Steps beginInSteps(const gl::Device& device, const Inputs& inputs);
    // The next so many faces, of which the last of the table is followed by the first; 0: all. Nothing is done after
    // enough rounds.
    base::Steps goOnInSteps(const gl::Device& device, const Inputs& inputs, std::uint32_t count);

    static std::vector<gl::ProgramDesc> programDescs();

  private:
    base::Steps draw(const gl::Device& device, const Inputs& inputs, std::uint32_t first,
                     std::uint32_t count);

    gl::Buffer means_, constants_;
    std::uint32_t round_ = 0, next_ = 0;
};

}  // namespace conelight::light
