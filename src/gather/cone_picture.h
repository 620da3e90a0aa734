// SPDX-License-Identifier: MIT
// The picture of mode `cones`: surfaces, lights, radiance volume -> direct light, diffuse and specular cones,
// put together. Also its view of occlusion. Readers of `output` need a texture-fetch barrier. GL state
// changed: program and its slots.
#pragma once

#include <vector>

#include "gather/cone_volume.h"
#include "gather/direct_light.h"
#include "gather/layer_shade.h"
#include "gather/picture_parts.h"

namespace conelight::gather {

class ConePicture {
  public:
    struct Target {
        const gl::Texture& output;
        const gl::Buffer* lookupCounters = nullptr;  // not null: adds lookups of cones
        const gl::Texture* diffuse = nullptr;  // irradiance / pi that was gathered; null: cones gather it
    };
    base::Steps drawInSteps(const gl::Device& device, const DirectInputs& pixels, const ConeVolume& volume,
                            PictureParts parts, Target target);
    base::Steps drawOcclusion(const gl::Device& device, const DirectInputs& pixels, const ConeVolume& volume,
                              Target target);
    // Records what the picture shows of one pixel.
    void record(const gl::Device& device, const DirectInputs& pixels, const ConeVolume& volume,
                ConeGather::Part part, StepRecorder& recorder);

    // Nothing is gathered without a bounce; the parts are black then.
    static PictureParts partsOf(const Settings& settings);

    static std::vector<gl::ProgramDesc> programDescs();

  private:
    DirectLight direct_;
    base::Steps drawLayers(const gl::Device& device, const ConeInputs& inputs, const ConeVolume& volume,
                           PictureParts parts, Target target);

    gl::Texture diffuse_, specular_, coat_;  // what was gathered, of the frame's size
    LayerShade layers_;
};

}  // namespace conelight::gather
