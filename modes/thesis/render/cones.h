// SPDX-License-Identifier: MIT
// The thesis's cone pass: G-buffer + ThesisVolume -> picture. One compute pass per pixel; what is switched
// on, regular or customised, and which defects, is compiled into the program (built when first asked for).
//
// Writes every pixel of `output` (RGBA32F); readers need a barrier. GL state changed: program and its slots.
#pragma once

#include "conelight/thesis/settings.h"
#include "gather/direct_light.h"
#include "gather/step_recorder.h"
#include "gl/device.h"
#include "thesis/render/volume.h"
#include "thesis/shaders/constants.h"

namespace conelight::thesis {

// Every defect on when `published`, else those that are switched on one by one.
ThesisDefects effectiveDefects(const ThesisSettings& settings);

// The numbers of the march for a volume of `size` voxels per axis: `auto` settings resolved, angles turned
// into spreads. Throws Error(Usage) for numbers with which a march would not end.
gpu::ThesisConstants thesisConstants(const ThesisSettings& settings, const gpu::ThesisGrid& grid, int size);

// The pass that adds a bounce to the volume (bounces.cpp): its diffuse cones, and which defects they have.
// `environment`: surroundings have a picture.
gl::ProgramDesc bounceDesc(const ThesisSettings& settings, bool environment);

class ThesisConePass {
  public:
    struct Inputs {
        const gather::DirectInputs& pixels;
        const ThesisVolume& volume;
        const Settings& settings;
    };
    // `lookupCounters` may be null; else three uints (diffuse, specular, occlusion) are added to.
    void draw(const gl::Device& device, const Inputs& inputs, const gl::Texture& output,
              const gl::Buffer* lookupCounters);

    // Records the recorder's pixel of the picture that draw() draws with these settings. Views of the volume
    // are recorded as component full.
    void record(const gl::Device& device, const Inputs& inputs, const gl::Texture& output,
                gather::StepRecorder& recorder);

    static std::vector<gl::ProgramDesc> programDescs();

  private:
    gl::Inputs given(const Inputs& inputs, const gl::Texture& output);

    gl::Buffer constants_;
};

}  // namespace conelight::thesis
