// SPDX-License-Identifier: MIT
// What cones bring in: RadianceVolume + GBuffer -> pictures of irradiance, occlusion and specular radiance,
// and RadianceVolume + face records -> one more bounce. docs/theory/4_gather.md, "Matt surfaces" and "Glossy
// surfaces".
//
// Every pass needs the frame block, the scene tables and (pixels) the G-buffer bound. Pictures are RGBA16F of
// the frame's size; their readers need gl::barrier(TextureFetch) after it. GL state changed: program, image
// unit 0, the storage binding of passes, BINDING_CONES, and what RadianceVolume::bind binds.
#pragma once

#include <vector>

#include "conelight/settings.h"
#include "gather/step_recorder.h"
#include "gl/buffer.h"
#include "gl/pass.h"
#include "gl/program.h"
#include "gl/texture.h"
#include "voxels/radiance_volume.h"
#include "voxels/surface_voxels.h"

namespace conelight::gather {

class ConeGather {
  public:
    ConeGather();

    // Sets up the cones for later passes; cheap unless they changed.
    void configure(const ConesSettings& settings, const voxels::RadianceLayout& layout);

    // `counters` of FrameContext::lookupCounters, or null.
    // Diffuse: rgb irradiance / pi, a the open part of the hemisphere.
    void gatherDiffuse(gl::ProgramLibrary& programs, gl::Profiler& profiler,
                       const voxels::RadianceVolume& volume, const gl::Texture& result,
                       const gl::Buffer* counters) const;
    // Occlusion within ConesSettings::occlusionDistance: a, 1 is open.
    void gatherOcclusion(gl::ProgramLibrary& programs, gl::Profiler& profiler,
                         const voxels::RadianceVolume& volume, const gl::Texture& result,
                         const gl::Buffer* counters) const;
    // Specular: rgb radiance in the lobe, a the open part of the cone.
    void gatherSpecular(gl::ProgramLibrary& programs, gl::Profiler& profiler,
                        const voxels::RadianceVolume& volume, const gl::Texture& result,
                        const gl::Buffer* counters) const;
    // Records the recorder's pixel (gather/step_recorder.h) of one of the three above; `result` as there, not
    // written.
    enum class Recorded { Diffuse, Specular, Occlusion };
    void record(gl::ProgramLibrary& programs, const voxels::RadianceVolume& volume, const gl::Texture& result,
                Recorded what, StepRecorder& recorder) const;
    // Irradiance of every face from the volume as it is. Ends with the barrier for shader storage.
    void gatherBounce(gl::ProgramLibrary& programs, gl::Profiler& profiler,
                      const voxels::RadianceVolume& volume, const voxels::SurfaceVoxels& surface) const;

    static std::vector<gl::ProgramDesc> programDescs();

  private:
    void bind(const voxels::RadianceVolume& volume) const;
    void run(gl::ProgramLibrary& programs, const gl::ProgramDesc& desc, const voxels::RadianceVolume& volume,
             const gl::Texture& result, const gl::Buffer* counters) const;

    OpacityModel opacity_ = OpacityModel::Area;
    gl::Buffer block_;
};

}  // namespace conelight::gather
