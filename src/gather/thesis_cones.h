// SPDX-License-Identifier: MIT
// The thesis's cone pass: G-buffer + ThesisVolume -> picture. One compute pass per pixel; what is switched
// on, regular or customised, and which defects, is compiled into the program (built when first asked for).
//
// Reads: frame block, scene tables, G-buffer, volume. Writes `output` (RGBA32F) as an image, every pixel;
// readers need a barrier. GL state changed: program, image unit 0, UNIT_GBUFFER and the next, UNIT_PASS,
// BINDING_PASS, BINDING_STORAGE_PASS.
#pragma once

#include "conelight/settings.h"
#include "conelight/thesis/settings.h"
#include "gather/step_recorder.h"
#include "gl/pass.h"
#include "gl/program.h"
#include "scene/gpu_scene.h"
#include "shared/thesis.h"
#include "view/gbuffer.h"
#include "voxels/thesis_volume.h"

namespace conelight::gather {

// Every defect on when `published`, else those that are switched on one by one.
thesis::ThesisDefects effectiveDefects(const thesis::ThesisSettings& settings);

// The numbers of the march for a volume of `size` voxels per axis: `auto` settings resolved, angles turned
// into spreads. Throws Error(Usage) for numbers with which a march would not end.
gpu::ThesisConstants thesisConstants(const thesis::ThesisSettings& settings, const gpu::ThesisGrid& grid,
                                     int size);

class ThesisConePass {
  public:
    // `lookupCounters` may be null; else three uints (diffuse, specular, occlusion) are added to.
    void render(gl::ProgramLibrary& programs, gl::Profiler& profiler, const scene::GpuScene& scene,
                const view::GBuffer& gbuffer, const voxels::ThesisVolume& volume, const Settings& settings,
                const gl::Texture& output, const gl::Buffer* lookupCounters);

    // Records the recorder's pixel of the picture that render() draws with these settings; of `output` only
    // the size is asked. Views of the volume are recorded as component full.
    void record(gl::ProgramLibrary& programs, const scene::GpuScene& scene, const view::GBuffer& gbuffer,
                const voxels::ThesisVolume& volume, const Settings& settings, StepRecorder& recorder);

    static std::vector<gl::ProgramDesc> programDescs();

  private:
    void bind(const scene::GpuScene& scene, const view::GBuffer& gbuffer, const voxels::ThesisVolume& volume,
              const Settings& settings);

    gl::Buffer constants_;
};

}  // namespace conelight::gather
