// SPDX-License-Identifier: MIT
// What cones bring in: RadianceVolume + GBuffer -> pictures of irradiance, occlusion and specular radiance,
// and RadianceVolume + faces -> one more bounce. docs/theory/4a_cones.md, "Diffuse surfaces" and
// "Glossy surfaces".
//
// Pictures are RGBA16F of the frame's size; their readers need gl::barrier(TextureFetch) after it. GL state
// changed: program and its slots.
#pragma once

#include <vector>

#include "base/steps.h"
#include "conelight/settings.h"
#include "gather/cone_shadows.h"
#include "gather/direct_light.h"
#include "gather/radiance_volume.h"
#include "gather/step_recorder.h"
#include "gl/device.h"
#include "gl/texture.h"
#include "voxels/surface_voxels.h"

namespace conelight::gather {

// What cones at pixels read.
struct ConeInputs {
    const DirectInputs& pixels;
    const RadianceVolume& volume;
};

class ConeGather {
  public:
    ConeGather();

    // Sets up the cones for later passes; cheap unless they changed.
    void configure(const ConesSettings& settings, const RadianceLayout& layout);

    // What a pass at pixels gathers:
    // Diffuse    rgb irradiance / pi, a the open part of the hemisphere
    // Specular   rgb radiance in the lobe, a the open part of the cone
    // Coat       as Specular, of clear coats where there are any
    // Occlusion  within ConesSettings::occlusionDistance: a, 1 is open
    enum class Part { Diffuse, Specular, Coat, Occlusion };
    // `counters` not null: adds lookups (shared/cones.h).
    void gather(const gl::Device& device, const ConeInputs& inputs, Part part, const gl::Texture& result,
                const gl::Buffer* counters) const {
        gatherInSteps(device, inputs, part, result, counters).finish();
    }
    base::Steps gatherInSteps(const gl::Device& device, const ConeInputs& inputs, Part part,
                              const gl::Texture& result, const gl::Buffer* counters) const;
    // Records the recorder's pixel (gather/step_recorder.h); `result` as there, not written.
    void record(const gl::Device& device, const ConeInputs& inputs, Part part, const gl::Texture& result,
                StepRecorder& recorder) const;
    // Irradiance of every face from the volume as it is, into `faces`. Ends with the barrier for shader
    // storage.
    struct BounceInputs {
        const light::Lights& lights;
        const RadianceVolume& volume;
        const voxels::SurfaceVoxels& surface;
        const gl::Buffer* corrections = nullptr;  // to add, of baked light (light::BakedFaces); null: none
    };
    void gatherBounce(const gl::Device& device, const BounceInputs& inputs,
                      const light::LitFaces& faces) const;

    // For cones from pixels to lights.
    ConeShadows shadows(const RadianceVolume& volume) const;
    static std::vector<gl::Defines> shadowDefines();  // all that shadows() may give

    static std::vector<gl::ProgramDesc> programDescs();

  private:
    gl::Inputs given(const ConeInputs& inputs, const gl::Texture& result) const;

    OpacityModel opacity_ = OpacityModel::Area;
    bool fractional_ = false;
    gl::Buffer block_;
};

}  // namespace conelight::gather
